#include <ao/gl/backend.hpp>
#include <functional>

// Names of a depth texture (GL_DEPTH_COMPONENT32F), of normals (GL_RGBA16F) and of a GL_R32F for the result; a current context.
std::optional<ao::error> run_gl(ao::gl::backend::get_proc_address loader, const ao::host_images<unsigned>& textures, int width,
                                int height, const std::function<bool(ao::camera&)>& next_frame)
{
    ao::camera camera{ .projection = ao::make_projection({}, { .range = ao::depth_range::minus_one_to_one }) };
    auto gl = ao::gl::backend::create(loader);
    if (!gl) return gl.error();
    const ao::facts facts{
        .width = width, .height = height, .depth = ao::depth_source::hardware, .depth_format = ao::pixel_format::d32f
    };
    auto effect = ao::effect<ao::gl::backend>::create(*gl, ao::settings{ .radius = 1.0F }, facts, camera);
    if (!effect) return effect.error();
    auto images = effect->bind(textures);
    if (!images) return images.error();
    while (next_frame(camera)) {
        if (auto wrong = effect->set_camera(camera)) return wrong;
        effect->record({}, *images); // after the G-buffer, before lighting
    }
    return std::nullopt;
}
