#include "stability/planted.hpp"

#include <cstddef>
#include <type_traits>
#include <vector>

// In each copy's namespace (planted_frame.cpp); the plain data behind the pointers is laid out alike.
#define AO_PLANTED(name)                                                                                                         \
    namespace name {                                                                                                             \
    std::vector<float> planted_frame(const void* settings, const void* facts, const void* camera,                                \
                                     const std::vector<std::byte>& depth, const std::vector<std::byte>& normal);                 \
    }
AO_PLANTED(planted_wrap)
AO_PLANTED(planted_mirror)
AO_PLANTED(planted_background)
AO_PLANTED(planted_blur)
#undef AO_PLANTED

namespace stability {

namespace {

static_assert(std::is_trivially_copyable_v<ao::settings> && std::is_trivially_copyable_v<ao::facts> &&
              std::is_trivially_copyable_v<ao::camera>);

template <class Frame>
frame_function run_by(Frame run)
{
    return [run](const shot& s, const stored_shot& pictures) -> ao::result<ao::picture> {
        const std::vector<float> seen = run(&s.settings, &s.facts, &s.camera, pictures.depth.bytes, pictures.normal.bytes);
        ao::picture made(ao::pixel_format::r32f, s.facts.width, s.facts.height);
        for (std::size_t i = 0; i < seen.size(); ++i) {
            made.set_texel(i, seen[i]);
        }
        return made;
    };
}

} // namespace

void plant_wrap(subject& s)
{
    s.frame_instead = run_by(planted_wrap::planted_frame);
}
void plant_mirror(subject& s)
{
    s.frame_instead = run_by(planted_mirror::planted_frame);
}
void plant_background(subject& s)
{
    s.frame_instead = run_by(planted_background::planted_frame);
}
void plant_blur(subject& s)
{
    s.frame_instead = run_by(planted_blur::planted_frame);
}

} // namespace stability
