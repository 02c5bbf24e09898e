// result and error in constant expressions.
#include "ao/result.hpp"

namespace {

constexpr ao::result<int> answer()
{
    return 42;
}
constexpr ao::result<int> failure()
{
    return ao::error(ao::errc::device, "lost", -4);
}
static_assert(answer() && answer().has_value() && *answer() == 42 && answer().value() == 42);
static_assert(!failure() && failure().error().code() == ao::errc::device && failure().error().native() == -4);
static_assert(failure().error().reason() == "lost");

// Long reasons are cut, not overrun.
constexpr std::size_t cut()
{
    char text[400] = {};
    for (char& c : text) {
        c = 'x';
    }
    return ao::error(ao::errc::shader, std::string_view(text, sizeof text)).reason().size();
}
static_assert(cut() == 255);

} // namespace
