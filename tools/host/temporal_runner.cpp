#include "host/temporal_runner.hpp"

#include "host/make_each.hpp"

#include <optional>

namespace ao::host {

const char* name(temporal_pass_type pass)
{
    switch (pass) {
    case temporal_pass_type::linearize:
        return "linearize";
    case temporal_pass_type::accumulate:
        return "accumulate";
    case temporal_pass_type::filter_rows:
        return "filter rows";
    case temporal_pass_type::filter_columns:
        return "filter columns";
    case temporal_pass_type::resolve:
        return "resolve";
    }
    return "";
}

ao::result<success> temporal_runner::check_inputs(const temporal_facts& f, const picture& depth, const picture& normal,
                                                  const picture& motion)
{
    const auto fits = [&](const picture& p, pixel_format format) {
        return p.format == format && p.width == f.frame.width && p.height == f.frame.height;
    };
    if (!fits(depth, f.frame.depth_format)) {
        return error(errc::invalid_size, "the depth picture has another size or format than the plan");
    }
    if (f.frame.normals != normal_source::from_depth && !fits(normal, f.frame.normal_format)) {
        return error(errc::invalid_size, "the normal picture has another size or format than the plan");
    }
    if (f.motion && !fits(motion, f.motion_format)) {
        return error(errc::invalid_size, "the motion picture has another size or format than the plan");
    }
    return success{};
}

namespace {

std::optional<ao::result<temporal_runner_ptr>> make_one([[maybe_unused]] std::string_view backend,
                                                        [[maybe_unused]] const std::string& device)
{
#ifdef AO_HAS_CPU
    if (backend == "cpu") {
        return make_cpu_temporal_runner();
    }
#endif
#ifdef AO_HAS_GL
    if (backend == "gl") {
        return make_gl_temporal_runner(gl_context_of(device), { .restore_state = false });
    }
#endif
#ifdef AO_HAS_VK
    if (backend == "vk") {
        return make_vk_temporal_runner({ .device = device });
    }
#endif
    return std::nullopt;
}

} // namespace

ao::result<std::vector<temporal_runner_ptr>> make_temporal_runners(std::string_view backend, const std::string& device)
{
    return make_each<temporal_runner_ptr>(backend, [&](std::string_view each) { return make_one(each, device); });
}

} // namespace ao::host
