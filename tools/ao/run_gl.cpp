#include "ao/gl/backend.hpp"
#include "ao/run_frames.hpp"
#include "host/gl_texture.hpp"

namespace ao::tools {
namespace {

// A name may belong to OSMesa's llvmpipe or to a GPU behind EGL.
std::unique_ptr<host::gl_context> make_context(const std::string& device)
{
    auto software = host::gl_context::create({ host::gl_platform::osmesa, device });
    if (software || device.empty())
        return take("gl", std::move(software));
    return take("gl", host::gl_context::create({ host::gl_platform::egl, device }));
}

} // namespace

run_outcome run_gl(const run_inputs& in, const std::string& device, bool fragment)
{
    const auto context = make_context(device);
    const auto finish = reinterpret_cast<void (*)()>(context->loader()("glFinish"));
    const auto texture = [&](const picture& p) {
        auto t = take("gl", host::gl_texture::create(*context, p.format,
                                                     { static_cast<unsigned>(p.width), static_cast<unsigned>(p.height) }));
        (void)take("gl", t.upload(p.bytes));
        return t;
    };
    const auto depth = texture(in.depth);
    std::optional<host::gl_texture> normal;
    if (in.facts.normals != normal_source::from_depth)
        normal = texture(in.normal);
    picture visibility(in.facts.output_format, in.facts.width, in.facts.height);
    const auto target = texture(visibility);

    gl::options options;
    options.route = fragment ? gl::route::fragment : gl::route::compute;
    options.restore_state = false;
    auto backend = take("gl", gl::backend::create(context->loader(), options));

    run_outcome out;
    out.backend = "gl";
    out.label = fragment ? "gl-fragment" : "gl";
    out.route = fragment ? "fragment" : "compute";
    out.route += backend.chosen().source == gl::shader_source::spirv ? ", SPIR-V" : ", GLSL";
    out.device = backend.device();

    const stopwatch since;
    auto effect = take("gl", ao::effect<gl::backend>::create(backend, in.settings, in.facts, in.camera));
    auto bound = take("gl", effect.bind({ depth.name, normal ? normal->name : 0, target.name }));
    time_frames(out, effect.current_plan(), in.frames, since,
                [&] { return draw_pass_by_pass(effect, gl::commands{}, bound, finish); });
    (void)take("gl", target.download(visibility.bytes));
    out.visibility = floats_of(visibility);
    return out;
}

} // namespace ao::tools
