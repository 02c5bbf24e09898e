#include <ao/plan.hpp>

// A plan made while compiling, as a stranger's project would.
constexpr ao::settings chosen = ao::checked({ .taps = 16, .filter = 1 });
constexpr ao::facts facts{ .width = 64, .height = 32 };
constexpr ao::result<ao::plan> planned = ao::make_plan(chosen, facts, { .projection = ao::make_projection({}) });
static_assert(planned && planned->passes.size() == 1);

int main(int count, char**)
{
    ao::settings run_time = chosen;
    run_time.taps = 16 * count;
    const auto again = ao::make_plan(run_time, facts, { .projection = ao::make_projection({}) });
    return again && again->passes[0].options == planned->passes[0].options ? 0 : 1;
}
