// Settings that validate at compile time.
#include "ao/settings.hpp"

#include <limits>
#include <string_view>

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

template <class Change>
constexpr ao::settings with(Change change)
{
    ao::settings s;
    change(s);
    return s;
}
constexpr bool refused(const ao::settings& s, std::string_view word)
{
    const auto wrong = ao::validate(s);
    return wrong && wrong->code() == ao::errc::invalid_settings && wrong->reason().find(word) != std::string_view::npos;
}
constexpr bool accepted(const ao::settings& s)
{
    return !ao::validate(s);
}

static_assert(accepted({}));
static_assert(ao::checked({}).taps == 32);
static_assert(ao::checked(with([](auto& s) { s.radius = 2.5F; })).radius == 2.5F);

static_assert(refused(with([](auto& s) { s.method = static_cast<ao::method>(4); }), "method"));
static_assert(refused(with([](auto& s) { s.slices = 0; }), "slices"));
static_assert(refused(with([](auto& s) { s.slices = ao::max_slices + 1; }), "slices"));
constexpr auto sliced = with([](auto& s) {
    s.method = ao::method::bitmask;
    s.taps = 12;
    s.slices = 3;
});
static_assert(!ao::validate(sliced));
static_assert(refused(with([](auto& s) {
                          s.method = ao::method::bitmask;
                          s.taps = 10;
                          s.slices = 3;
                      }),
                      "taps"));
static_assert(!ao::validate(ao::settings_of(ao::preset::low)) && !ao::validate(ao::settings_of(ao::preset::ultra, 3.0F)));
static_assert(ao::settings_of(ao::preset::high).taps == 18 && ao::settings_of(ao::preset::high, 3.0F).radius == 3.0F);
static_assert(refused(with([](auto& s) { s.taps = 0; }), "taps"));
static_assert(refused(with([](auto& s) { s.taps = -1; }), "taps"));
static_assert(refused(with([](auto& s) { s.taps = 1000000; }), "taps"));
static_assert(accepted(with([](auto& s) { s.taps = 1; })) && accepted(with([](auto& s) { s.taps = ao::max_taps; })));
static_assert(refused(with([](auto& s) { s.taps = ao::max_taps + 1; }), "taps"));

static_assert(refused(with([](auto& s) { s.radius = 0; }), "radius"));
static_assert(refused(with([](auto& s) { s.radius = -1; }), "radius"));
static_assert(refused(with([](auto& s) { s.radius = 1e30F; }), "radius"));
static_assert(refused(with([](auto& s) { s.radius = nan; }), "radius"));
static_assert(refused(with([](auto& s) { s.radius = inf; }), "radius"));
static_assert(accepted(with([](auto& s) { s.radius = 1e15F; })) && accepted(with([](auto& s) { s.radius = 1e-30F; })));

static_assert(refused(with([](auto& s) { s.bias = -1e-6F; }), "bias"));
static_assert(refused(with([](auto& s) { s.bias = nan; }), "bias"));
static_assert(refused(with([](auto& s) { s.bias = inf; }), "bias"));
static_assert(accepted(with([](auto& s) { s.bias = 0; })));

static_assert(refused(with([](auto& s) { s.thickness = 0; }), "thickness"));
static_assert(refused(with([](auto& s) { s.thickness = nan; }), "thickness"));
static_assert(accepted(with([](auto& s) { s.thickness = 1; })) && accepted(with([](auto& s) { s.thickness = inf; })));

static_assert(refused(with([](auto& s) { s.filter = 4; }), "filter"));
static_assert(refused(with([](auto& s) { s.filter = 0; }), "filter"));
static_assert(refused(with([](auto& s) { s.filter = -3; }), "filter"));
static_assert(refused(with([](auto& s) { s.filter = 33; }), "filter"));
static_assert(accepted(with([](auto& s) { s.filter = 1; })) && accepted(with([](auto& s) { s.filter = ao::max_filter; })));

} // namespace
