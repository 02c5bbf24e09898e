// A rasterizer and a shading executor together with a context of their own, pictures and a clock: the counterpart of
// host/runner.hpp for scenes.
#pragma once

#include "ao/gbuffer.hpp"
#include "ao/picture.hpp"
#include "ao/result.hpp"
#include "ao/shading.hpp"
#include "ao/texture.hpp"
#include "host/runner.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ao::host {

// Targets of a geometry pass, what shading reads beside them, and what it writes.
enum class scene_picture { depth, position, normal, motion, ids, surface, frame, visibility, color };
inline constexpr std::size_t scene_picture_count = 9;
const char* name(scene_picture which);
// Nothing where the facts leave the target out; visibility and color are none.
std::optional<pixel_format> format_of(const gbuffer_facts& f, scene_picture which);

struct draw_counts {
    std::size_t draws = 0;    // objects that are drawn
    std::size_t variants = 0; // of shaders, those in use
    std::size_t programs = 0; // compiled
    std::size_t calls = 0;    // to the driver, a frame
    std::size_t skipped_triangles = 0;
};

class scene_runner {
public:
    scene_runner() = default;
    scene_runner(const scene_runner&) = delete;
    scene_runner& operator=(const scene_runner&) = delete;
    virtual ~scene_runner() = default;

    // As runner's.
    virtual std::string_view backend() const = 0;
    virtual std::string device() const = 0;
    virtual std::string route() const = 0;
    std::string name() const { return std::string(backend()) + " (" + route() + ")"; }
    virtual bool exact() const = 0;
    virtual std::vector<std::string> messages() const { return {}; }

    // Makes the targets that the facts ask for, in place of those before. What was loaded or prepared is gone.
    virtual ao::result<success> make_targets(const gbuffer_facts& facts) = 0;
    // Makes the targets too, compiles and uploads what draws the scene into them.
    virtual ao::result<success> load(const scene& s, const gbuffer_facts& facts) = 0;
    // The transforms of the scene's objects as they are now. Precondition: the scene is loaded.
    virtual ao::result<success> move(const scene& s) = 0;
    // Draws a frame to its end; milliseconds, by the device's clock where it has one. Precondition: a scene is loaded.
    virtual ao::result<double> draw(const gbuffer_camera& camera) = 0;
    virtual draw_counts counts() const = 0;

    // In place of drawing. Precondition for this and what follows: the targets are made. Fails for what is no target of the
    // facts, and for another size or format. A visibility has the facts' size and the format r32f or r8.
    virtual ao::result<success> upload(scene_picture which, const picture& from) = 0;
    // A target as it was drawn or uploaded, or the color; rows and bits as they are in memory.
    virtual ao::result<picture> download(scene_picture which) = 0;

    // Compiles for the plan. The heap may go afterwards. A visibility that the plan reads is open everywhere until it is
    // uploaded. Fails where a picture that the plan reads is not among the targets.
    virtual ao::result<success> prepare_shading(const shade_plan& p, const texel_heap& heap) = 0;
    // The plan with other lights, weights or another camera. Precondition for this and what follows: shading is prepared.
    virtual ao::result<success> update_shading(const shade_plan& p) = 0;
    // All passes; milliseconds.
    virtual ao::result<double> shade() = 0;
    // Weights of blends outside [0, 1] or NaN since shading was prepared, one for each pixel and use.
    virtual ao::result<std::uint64_t> clamped_weights() = 0;

protected:
    static ao::result<success> check_upload(const gbuffer_facts& f, scene_picture which, const picture& from);
    static ao::result<success> check_plan(const gbuffer_facts& f, const shade_plan& p);
};

using scene_runner_ptr = std::unique_ptr<scene_runner>;

#ifdef AO_HAS_CPU
ao::result<scene_runner_ptr> make_cpu_scene_runner(const cpu::options& o = {});
#endif
#ifdef AO_HAS_GL
ao::result<scene_runner_ptr> make_gl_scene_runner(const gl_options& context = {}, const gl::raster_options& o = {});
#endif
#ifdef AO_HAS_VK
ao::result<scene_runner_ptr> make_vk_scene_runner(const vk_runner_options& o = {});
#endif

// What `--backend` and `--device` name, as make_runners; `all` are those that the program was built with.
ao::result<std::vector<scene_runner_ptr>> make_scene_runners(std::string_view backend, const std::string& device = {});

} // namespace ao::host
