// Sequences of frames for executors of temporal plans, in every format that a plan may read, some with poison in them.
#pragma once

#include "ao/conformance/functions.hpp"
#include "unit/temporal_scene.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace temporal_test {

struct temporal_case {
    std::string name;
    ao::temporal_settings settings;
    ao::temporal_facts facts;
    bool poison = false; // numbers that are none, in every picture and in the history
    float background = ao::max_eye_depth;
    int frames = 26;
};

struct sequence_frame {
    scene_frame frame;
    bool cut = false;
    bool fault = false; // the history is to be spoilt before it
};

// What a camera does: it stands, moves by less than a pixel and by more, stands again, cuts to another place, stands and moves.
inline std::vector<stage> make_stages(const temporal_case& c)
{
    stage s{ .width = c.facts.frame.width, .height = c.facts.frame.height };
    s.ball = -0.6;
    std::vector<stage> stages;
    for (int i = 0; i < c.frames; ++i) {
        if ((i >= 3 && i < 10) || (i > 14 && i >= 18)) {
            s.eye[0] += i % 2 == 0 ? 0.006 : 0.05;
            s.eye[1] += 0.004;
            s.yaw += i == 9 ? 0.1 : 0.003;
            s.ball += c.facts.motion ? 0.07 : 0;
        }
        if (i == 14) {
            s.eye = { -1, 0.3, 0.5 };
            s.yaw = 0.2;
        }
        stages.push_back(s);
    }
    return stages;
}

namespace detail {

// The depth picture's eye depths, in the case's format.
inline void convert_depth(scene_frame& f, const ao::facts& to)
{
    std::vector<float> depth;
    for (std::size_t i = 0; i < f.inputs.depth.pixels(); ++i) {
        depth.push_back(f.inputs.depth.texel<float>(i));
    }
    f.inputs.depth = ao::pack_depth(depth, to.width, to.height, to.depth, to.depth_format, f.camera.projection);
}

inline void convert_normals(scene_frame& f, const ao::facts& to)
{
    if (to.normals == ao::normal_source::from_depth) {
        f.inputs.normal = {};
        return;
    }
    std::vector<glm::vec3> normals;
    for (std::size_t i = 0; i < f.inputs.normal.pixels(); ++i) {
        normals.emplace_back(f.inputs.normal.texel<glm::vec4>(i));
    }
    f.inputs.normal = ao::pack_normals(normals, to.width, to.height, to.normals, to.normal_format);
}

// Motion in the case's convention and format, and the jitter that a host adds.
inline void convert_motion(scene_frame& f, const ao::temporal_facts& to, int index)
{
    if (!to.motion) {
        f.inputs.motion = {};
        return;
    }
    const ao::motion_convention& m = to.convention;
    if (!m.jittered) {
        f.camera.jitter_x = 0.25F * static_cast<float>(index % 4);
        f.camera.jitter_y = -0.125F * static_cast<float>(index % 3);
    }
    const float side = m.from_previous ? -1.0F : 1.0F;
    const auto scale = [&](int size, float up) {
        const float unit =
            m.unit == ao::motion_unit::pixels ? 1.0F : (m.unit == ao::motion_unit::ndc ? 2.0F : 1.0F) / static_cast<float>(size);
        return side * up * unit;
    };
    const float x = scale(to.frame.width, 1);
    const float y = scale(to.frame.height, m.y_up ? -1.0F : 1.0F);
    ao::picture made(to.motion_format, to.frame.width, to.frame.height);
    for (std::size_t i = 0; i < made.pixels(); ++i) {
        const auto v = f.inputs.motion.texel<glm::vec4>(i);
        const glm::vec4 stored(v.x * x, v.y * y, v.z, 0.0F);
        if (to.motion_format == ao::pixel_format::rg32f) {
            made.set_texel(i, glm::vec2(stored));
        }
        else if (to.motion_format == ao::pixel_format::rgba32f) {
            made.set_texel(i, stored);
        }
        else {
            made.set_texel(i, std::array<std::uint16_t, 4>{ ao::float_to_half(stored.x), ao::float_to_half(stored.y),
                                                            ao::float_to_half(stored.z), 0 });
        }
    }
    f.inputs.motion = made;
}

// Every few texels, one component of a picture of 32-bit floats becomes something that no host means.
inline void spoil(ao::picture& p, ao::random_stream& random)
{
    constexpr float infinite = std::numeric_limits<float>::infinity();
    constexpr std::array<float, 8> bad{
        std::numeric_limits<float>::quiet_NaN(), infinite, -infinite, 1e30F, -1e6F, 0.0F, -1.0F, 3e38F
    };
    for (std::size_t at = random.next() % 17; 4 * at < p.bytes.size(); at += 1 + random.next() % 31) {
        std::memcpy(p.bytes.data() + 4 * at, &bad[random.next() % bad.size()], 4);
    }
}

} // namespace detail

// A history as no executor leaves it: each word kept, or NaN, infinite, negative, or any word whose exponent as a float is no
// extreme one, so that no product with it is a denormal, which drivers may take for 0.
inline void spoil_history(std::vector<std::uint32_t>& words, std::uint32_t seed)
{
    constexpr std::array<std::uint32_t, 6> bad{ 0x7fc00000U, 0x7f800000U, 0xff800000U, 0xbf800000U, 0x7f7fffffU, 0x47000000U };
    ao::random_stream random(seed);
    for (std::uint32_t& word : words) {
        const std::uint32_t kind = random.next() % 8;
        if (kind == 0) {
            word = bad[random.next() % bad.size()];
        }
        else if (kind == 1) {
            word = (random.next() & 0x807fffffU) | (107U + random.next() % 40U) << 23U;
        }
    }
}

inline std::vector<sequence_frame> make_sequence(const temporal_case& c)
{
    const std::vector<stage> stages = make_stages(c);
    ao::random_stream random(19);
    std::vector<sequence_frame> frames;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        sequence_frame f{ make_frame(stages[i], stages[i == 0 ? 0 : i - 1]), i == 14, c.poison && i % 5 == 4 };
        f.frame.camera.background = c.background;
        if (c.facts.frame.parallel) {
            f.frame.camera.projection = ao::make_projection({ -3, 3, -2, 2, 0.4, 200 }, { .parallel = true });
        }
        if (c.facts.frame.world_normals) {
            f.frame.camera.normal_to_view = f.frame.camera.world_to_view;
        }
        detail::convert_depth(f.frame, c.facts.frame);
        detail::convert_normals(f.frame, c.facts.frame);
        detail::convert_motion(f.frame, c.facts, static_cast<int>(i));
        if (c.poison) {
            detail::spoil(f.frame.inputs.depth, random);
            detail::spoil(f.frame.inputs.normal, random);
            detail::spoil(f.frame.inputs.motion, random);
        }
        frames.push_back(f);
    }
    return frames;
}

} // namespace temporal_test
