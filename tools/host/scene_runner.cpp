#include "host/scene_runner.hpp"

#include "host/make_each.hpp"

#include <utility>

namespace ao::host {

const char* name(scene_picture which)
{
    constexpr const char* names[scene_picture_count] = { "depth",   "position", "normal",     "motion", "ids",
                                                         "surface", "frame",    "visibility", "color" };
    return names[static_cast<std::size_t>(which)];
}

std::optional<pixel_format> format_of(const gbuffer_facts& f, scene_picture which)
{
    const auto where = [](bool asked, pixel_format format) { return asked ? std::optional(format) : std::nullopt; };
    switch (which) {
    case scene_picture::depth:
        return f.depth_format;
    case scene_picture::position:
        return where(f.position, f.position_format);
    case scene_picture::normal:
        return where(f.normal && f.normals != normal_source::from_depth, f.normal_format);
    case scene_picture::motion:
        return where(f.motion, f.motion_format);
    case scene_picture::ids:
        return where(f.ids, pixel_format::rg32ui);
    case scene_picture::surface:
        return where(f.surface, pixel_format::rgba32f);
    case scene_picture::frame:
        return where(f.frame, pixel_format::rgba32f);
    case scene_picture::visibility:
    case scene_picture::color:
        break;
    }
    return std::nullopt;
}

ao::result<success> scene_runner::check_upload(const gbuffer_facts& f, scene_picture which, const picture& from)
{
    const std::string what = host::name(which);
    const std::optional<pixel_format> target = format_of(f, which);
    const bool visibility = which == scene_picture::visibility;
    if (!target && !visibility) {
        return error(errc::plan_mismatch, "there is no " + what + " picture to upload to");
    }
    const auto one_of = [&](auto... formats) { return ((from.format == formats) || ...); };
    const bool fits = visibility ? one_of(pixel_format::r32f, pixel_format::r8, pixel_format::rgba16f) : from.format == *target;
    if (!fits || from.width != f.width || from.height != f.height ||
        from.bytes.size() != picture(from.format, f.width, f.height).bytes.size()) {
        return error(errc::invalid_size, "the " + what + " picture has another size or format than the targets");
    }
    return success{};
}

ao::result<success> scene_runner::check_plan(const gbuffer_facts& f, const shade_plan& p)
{
    const auto missing = [](const char* what) {
        return error(errc::plan_mismatch, std::string("the plan reads a ") + what + " picture that is not among the targets");
    };
    const shade_facts& s = p.facts;
    if (s.width != f.width || s.height != f.height) {
        return error(errc::invalid_size, "the plan has another size than the targets");
    }
    if (s.stored_position ? format_of(f, scene_picture::position) != s.position_format : f.depth_format != s.depth_format) {
        return missing(s.stored_position ? "position" : "depth");
    }
    if (format_of(f, scene_picture::normal) != s.normal_format || f.normals != s.normals) {
        return missing("normal");
    }
    if (!f.ids) {
        return missing("ids");
    }
    if (p.options.maps && !f.surface) {
        return missing("surface");
    }
    if (p.options.frames && !f.frame) {
        return missing("frame");
    }
    return success{};
}

namespace {

using made = ao::result<std::vector<scene_runner_ptr>>;

// Nothing where the program was built without the backend.
std::optional<ao::result<scene_runner_ptr>> make_one(std::string_view backend, [[maybe_unused]] const std::string& device)
{
#ifdef AO_HAS_CPU
    if (backend == "cpu") {
        return make_cpu_scene_runner();
    }
#endif
#ifdef AO_HAS_GL
    if (backend == "gl") {
        return make_gl_scene_runner(gl_context_of(device), { .restore_state = false });
    }
#endif
#ifdef AO_HAS_VK
    if (backend == "vk") {
        return make_vk_scene_runner({ .device = device });
    }
#endif
    return std::nullopt;
}

} // namespace

made make_scene_runners(std::string_view backend, const std::string& device)
{
    return make_each<scene_runner_ptr>(backend, [&](std::string_view each) { return make_one(each, device); });
}

} // namespace ao::host
