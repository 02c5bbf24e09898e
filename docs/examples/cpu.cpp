#include <ao/cpu/backend.hpp>
#include <functional>

// Eye depth (R32F) and view-space normals (RGBA16F) in, visibility (R32F) out. `next_frame` fills the inputs, false: done.
std::optional<ao::error> run_cpu(const ao::picture& depth, const ao::picture& normals, ao::picture& visibility,
                                 const std::function<bool(ao::camera&)>& next_frame)
{
    ao::camera camera{ .projection = ao::make_projection({ -1.0, 1.0, -0.5625, 0.5625, 0.1, 100.0 }) };
    auto cpu = ao::cpu::backend::create();
    if (!cpu) return cpu.error();
    const ao::facts facts{ .width = depth.width, .height = depth.height };
    auto effect = ao::effect<ao::cpu::backend>::create(*cpu, ao::settings{ .radius = 1.0F }, facts, camera);
    if (!effect) return effect.error();
    auto images = effect->bind({ ao::cpu::view_of(depth), ao::cpu::view_of(normals), ao::cpu::view_of(visibility) });
    if (!images) return images.error();
    while (next_frame(camera)) {
        if (auto wrong = effect->set_camera(camera)) return wrong;
        effect->record({}, *images); // done when it returns: ambient light *= visibility
    }
    return std::nullopt;
}
