#include "host/runner.hpp"

#include <array>
#include <utility>

namespace ao::host {

ao::result<success> runner::check_inputs(const facts& known, const picture& depth, const picture& normal)
{
    const auto fits = [&](const picture& p, pixel_format format) {
        return p.format == format && p.width == known.width && p.height == known.height;
    };
    if (!fits(depth, known.depth_format)) {
        return error(errc::invalid_size, "the depth picture has another size or format than the plan");
    }
    if (known.normals != normal_source::from_depth && !fits(normal, known.normal_format)) {
        return error(errc::invalid_size, "the normal picture has another size or format than the plan");
    }
    return success{};
}

ao::result<picture> runner::run(const settings& chosen, const facts& known, const camera& view, const picture& depth,
                                const picture& normal)
{
    if (const auto done = prepare(chosen, known, view); !done) {
        return done.error();
    }
    if (const auto done = upload(depth, normal); !done) {
        return done.error();
    }
    if (const auto done = frame(); !done) {
        return done.error();
    }
    return download();
}

#ifdef AO_HAS_GL
gl_options gl_context_of(const std::string& device)
{
    // Part of the word, or the whole name that device() gives.
    const bool software = contains_ignoring_case("llvmpipe", device) || contains_ignoring_case(device, "llvmpipe");
    return { software ? gl_platform::osmesa : gl_platform::egl, device };
}
#endif

namespace {

using made = ao::result<std::vector<runner_ptr>>;

error unknown_route(std::string_view backend, std::string_view route)
{
    return error(errc::invalid_settings, "backend " + std::string(backend) + " has no route \"" + std::string(route) + "\"");
}

[[maybe_unused]] error not_built(std::string_view backend)
{
    return error(errc::invalid_settings, "this program was built without the backend " + std::string(backend));
}

std::optional<error> add(std::vector<runner_ptr>& to, ao::result<runner_ptr> next)
{
    if (!next) {
        return next.error();
    }
    to.push_back(std::move(*next));
    return std::nullopt;
}

std::optional<error> add_cpu([[maybe_unused]] std::vector<runner_ptr>& to, [[maybe_unused]] std::string_view route)
{
#ifdef AO_HAS_CPU
    constexpr std::array<std::pair<std::string_view, cpu::width>, 5> routes{ {
        { "", cpu::width::automatic },
        { "scalar", cpu::width::scalar },
        { "lanes4", cpu::width::lanes4 },
        { "lanes8", cpu::width::lanes8 },
        { "lanes16", cpu::width::lanes16 },
    } };
    for (const auto& [name, width] : routes) {
        if (name == route) {
            return add(to, make_cpu_runner({ .lanes = width }));
        }
    }
    return unknown_route("cpu", route);
#else
    return not_built("cpu");
#endif
}

std::optional<error> add_gl([[maybe_unused]] std::vector<runner_ptr>& to, [[maybe_unused]] const std::string& device,
                            [[maybe_unused]] std::string_view route)
{
#ifdef AO_HAS_GL
    if (!route.empty() && route != "compute" && route != "fragment") {
        return unknown_route("gl", route);
    }
    // Nobody else's state is in a context of its own.
    return add(
        to, make_gl_runner(gl_context_of(device),
                           { .route = route == "fragment" ? gl::route::fragment : gl::route::compute, .restore_state = false }));
#else
    return not_built("gl");
#endif
}

std::optional<error> add_vk([[maybe_unused]] std::vector<runner_ptr>& to, [[maybe_unused]] const std::string& device,
                            [[maybe_unused]] std::string_view route)
{
#ifdef AO_HAS_VK
    if (!route.empty() && route != "compute") {
        return unknown_route("vk", route);
    }
    return add(to, make_vk_runner({ .device = device }));
#else
    return not_built("vk");
#endif
}

} // namespace

made make_runners(std::string_view backend, const std::string& device, std::string_view route)
{
    std::vector<runner_ptr> runners;
    std::optional<error> wrong;
    if (backend == "cpu") {
        wrong = add_cpu(runners, route);
    }
    else if (backend == "gl") {
        wrong = add_gl(runners, device, route);
    }
    else if (backend == "vk") {
        wrong = add_vk(runners, device, route);
    }
    else if (backend == "all") {
        if (!route.empty()) {
            return error(errc::invalid_settings, "a route belongs to one backend, not to all");
        }
        wrong = add_cpu(runners, "");
        wrong = wrong ? wrong : add_gl(runners, device, "compute");
        wrong = wrong ? wrong : add_gl(runners, device, "fragment");
        wrong = wrong ? wrong : add_vk(runners, device, "");
    }
    else {
        return error(errc::invalid_settings, "unknown backend \"" + std::string(backend) + "\": cpu, gl, vk or all");
    }
    if (wrong) {
        return *wrong;
    }
    return runners;
}

} // namespace ao::host
