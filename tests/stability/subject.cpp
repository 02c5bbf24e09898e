#include "stability/subject.hpp"

#include "ao/conformance/reference.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace stability {

namespace {

template <class Made>
auto shared(Made made) -> std::shared_ptr<typename std::remove_reference_t<decltype(*made)>::element_type>
{
    return made ? std::move(*made) : nullptr;
}

// All bytes that a program depends on; padding may tell two alike apart, which only costs time.
std::vector<std::byte> key_of(const shot& s)
{
    std::vector<std::byte> key(sizeof(ao::settings) + sizeof(ao::facts));
    std::memcpy(key.data(), &s.settings, sizeof(ao::settings));
    std::memcpy(key.data() + sizeof(ao::settings), &s.facts, sizeof(ao::facts));
    return key;
}

} // namespace

stored_shot store(const shot& s)
{
    stored_shot stored;
    const ao::facts& f = s.facts;
    stored.depth = ao::pack_depth(s.depth, f.width, f.height, f.depth, f.depth_format, s.camera.projection);
    if (f.normals != ao::normal_source::from_depth) {
        stored.normal = ao::pack_normals(s.normals, f.width, f.height, f.normals, f.normal_format);
    }
    return stored;
}

const char* subject::name() const
{
    switch (kind_) {
    case kind::cpu_scalar:
        return "cpu scalar";
    case kind::cpu_lanes:
        return "cpu lanes";
    case kind::gl:
        return "gl";
    case kind::vk:
        break;
    }
    return "vk";
}

void subject::heal()
{
    faulty = false;
    evaluate_instead = nullptr;
    frame_instead = nullptr;
    change_shot = nullptr;
    change_visibility = nullptr;
    change_temporal = nullptr;
}

ao::host::runner* subject::passes()
{
    baker_ = nullptr; // on GL its context must stay the current one
    if (!passes_) {
        switch (kind_) {
#ifdef AO_HAS_CPU
        case kind::cpu_scalar:
            passes_ = shared(ao::host::make_cpu_runner({ .lanes = ao::cpu::width::scalar }));
            break;
        case kind::cpu_lanes:
            passes_ = shared(ao::host::make_cpu_runner());
            break;
#endif
#ifdef AO_HAS_GL
        case kind::gl:
            passes_ = shared(ao::host::make_gl_runner());
            break;
#endif
#ifdef AO_HAS_VK
        case kind::vk:
            passes_ = shared(ao::host::make_vk_runner());
            break;
#endif
        default:
            break;
        }
    }
    return passes_.get();
}

ao::host::temporal_runner* subject::temporal()
{
    baker_ = nullptr; // on GL its context must stay the current one
    if (!temporal_) {
        switch (kind_) {
#ifdef AO_HAS_CPU
        case kind::cpu_scalar:
            temporal_ = shared(ao::host::make_cpu_temporal_runner({ .lanes = ao::cpu::width::scalar }));
            break;
        case kind::cpu_lanes:
            temporal_ = shared(ao::host::make_cpu_temporal_runner());
            break;
#endif
#ifdef AO_HAS_GL
        case kind::gl:
            temporal_ = shared(ao::host::make_gl_temporal_runner());
            break;
#endif
#ifdef AO_HAS_VK
        case kind::vk:
            temporal_ = shared(ao::host::make_vk_temporal_runner());
            break;
#endif
        default:
            break;
        }
    }
    return temporal_.get();
}

ao::host::scene_runner* subject::scene()
{
    baker_ = nullptr; // on GL its context must stay the current one
    if (!scene_) {
        switch (kind_) {
#ifdef AO_HAS_CPU
        case kind::cpu_scalar:
            scene_ = shared(ao::host::make_cpu_scene_runner({ .lanes = ao::cpu::width::scalar }));
            break;
        case kind::cpu_lanes:
            scene_ = shared(ao::host::make_cpu_scene_runner());
            break;
#endif
#ifdef AO_HAS_GL
        case kind::gl:
            scene_ = shared(ao::host::make_gl_scene_runner());
            break;
#endif
#ifdef AO_HAS_VK
        case kind::vk:
            scene_ = shared(ao::host::make_vk_scene_runner());
            break;
#endif
        default:
            break;
        }
    }
    return scene_.get();
}

ao::host::bake_runner* subject::baker()
{
    if (!baker_) {
        switch (kind_) {
#ifdef AO_HAS_CPU
        case kind::cpu_scalar:
            baker_ = shared(ao::host::make_cpu_bake_runner({ .device = {}, .lanes = 1, .threads = 0 }));
            break;
        case kind::cpu_lanes:
            baker_ = shared(ao::host::make_cpu_bake_runner());
            break;
#endif
#ifdef AO_HAS_GL
        case kind::gl:
            baker_ = shared(ao::host::make_gl_bake_runner());
            break;
#endif
#ifdef AO_HAS_VK
        case kind::vk:
            baker_ = shared(ao::host::make_vk_bake_runner());
            break;
#endif
        default:
            break;
        }
    }
    return baker_.get();
}

std::vector<float> subject::frame(const shot& s)
{
    if (change_shot) {
        shot changed = s;
        change_shot(changed);
        return frame(changed, store(changed));
    }
    return frame(s, store(s));
}

std::vector<float> subject::frame(const shot& s, const stored_shot& pictures)
{
    std::vector<float> seen(s.depth.size(), std::numeric_limits<float>::quiet_NaN());
    const auto made = [&]() -> ao::result<ao::picture> {
        if (frame_instead) {
            return frame_instead(s, pictures);
        }
        ao::host::runner& r = *passes();
        std::vector<std::byte> key = key_of(s);
        if (!prepared_ || *prepared_ != key) {
            prepared_.reset();
            if (const auto done = r.prepare(s.settings, s.facts, s.camera); !done) {
                return done.error();
            }
            prepared_ = std::move(key);
        }
        else if (const auto done = r.set_camera(s.camera); !done) {
            return done.error();
        }
        if (const auto done = r.upload(pictures.depth, pictures.normal); !done) {
            return done.error();
        }
        if (const auto done = r.frame(); !done) {
            return done.error();
        }
        return r.download();
    }();
    if (made) {
        for (std::size_t i = 0; i < made->pixels(); ++i) {
            seen[i] = ao::conformance::decode_texel<float>(*made, i).x;
        }
    }
    if (change_visibility) {
        change_visibility(seen);
    }
    return seen;
}

std::vector<glm::vec4> subject::evaluate(int function, const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b)
{
    std::vector<glm::vec4> out(a.size(), glm::vec4(std::numeric_limits<float>::quiet_NaN()));
    if (evaluate_instead) {
        evaluate_instead(function, a, b, out);
    }
    else if (!passes()->evaluate(function, a, b, out)) {
        std::fill(out.begin(), out.end(), glm::vec4(std::numeric_limits<float>::quiet_NaN()));
    }
    return out;
}

std::vector<subject> all_subjects(bool thorough)
{
    std::vector<subject> all;
#ifdef AO_HAS_CPU
    all.emplace_back(subject::kind::cpu_scalar, thorough);
    all.emplace_back(subject::kind::cpu_lanes, thorough);
#endif
#ifdef AO_HAS_GL
    all.emplace_back(subject::kind::gl, thorough);
#endif
#ifdef AO_HAS_VK
    all.emplace_back(subject::kind::vk, thorough);
#endif
    return all;
}

} // namespace stability
