#include "host/bake_runner.hpp"

#include "host/make_each.hpp"

#include <optional>
#include <string>

namespace ao::host {
namespace {

// Nothing where the program was built without the backend.
std::optional<ao::result<bake_runner_ptr>> make_one(std::string_view backend, [[maybe_unused]] const bake_runner_options& o)
{
#ifdef AO_HAS_CPU
    if (backend == "cpu") {
        return make_cpu_bake_runner(o);
    }
#endif
#ifdef AO_HAS_GL
    if (backend == "gl") {
        return make_gl_bake_runner(o);
    }
#endif
#ifdef AO_HAS_VK
    if (backend == "vk") {
        return make_vk_bake_runner(o);
    }
#endif
    return std::nullopt;
}

} // namespace

ao::result<bake_runner_ptr> make_bake_runner(std::string_view backend, const bake_runner_options& o)
{
    if (backend == "all") {
        return error(errc::invalid_settings, "a bake takes one backend: cpu, gl or vk");
    }
    auto made = make_each<bake_runner_ptr>(backend, [&](std::string_view each) { return make_one(each, o); });
    if (!made) {
        return made.error();
    }
    return std::move(made->front());
}

} // namespace ao::host
