#include <ao/cpu/temporal.hpp>
#include <functional>

// Eye depth (R32F), view-space normals (RGBA16F) and motion in pixels (RG32F) in, visibility (R32F) out, from as many frames as
// the surfaces have been seen in. `next_frame` fills the inputs and says of a cut, false: done.
std::optional<ao::error> run_temporal(const ao::picture& depth, const ao::picture& normals, const ao::picture& motion,
                                      ao::picture& visibility,
                                      const std::function<bool(ao::temporal_camera&, bool& cut)>& next_frame)
{
    auto cpu = ao::cpu::temporal::create();
    if (!cpu) return cpu.error();
    const ao::temporal_facts facts{ .frame = { .width = depth.width, .height = depth.height },
                                    .motion = true,
                                    .convention = { .unit = ao::motion_unit::pixels } };
    auto effect = ao::temporal_effect<ao::cpu::temporal>::create(*cpu, { .radius = 1.0F }, facts);
    if (!effect) return effect.error();
    auto images = effect->bind(
        { ao::cpu::view_of(depth), ao::cpu::view_of(normals), ao::cpu::view_of(motion), ao::cpu::view_of(visibility) });
    if (!images) return images.error();
    ao::temporal_camera view; // projection, rotation and eye of each frame
    for (bool cut = false; next_frame(view, cut); cut = false) {
        if (auto wrong = effect->record({}, *images, view, cut)) return wrong;
    }
    return std::nullopt;
}
