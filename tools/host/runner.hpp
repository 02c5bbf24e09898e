// A backend together with a context of its own, pictures and a clock: what the program `ao` and the tests drive. Every runner
// is a subject of ao/conformance/suite.hpp.
#pragma once

#include "ao/picture.hpp"
#include "ao/plan.hpp"
#include "ao/result.hpp"

#include <glm/vec4.hpp>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#ifdef AO_HAS_CPU
#include "ao/cpu/backend.hpp"
#endif
#ifdef AO_HAS_GL
#include "ao/gl/options.hpp"
#include "host/gl_context.hpp"
#endif
#ifdef AO_HAS_VK
#include "ao/vk/backend.hpp"
#include "host/vulkan_device.hpp"
#endif

namespace ao::host {

struct pass_time {
    pass_type pass{};
    double ms = 0;
};

class runner {
public:
    runner() = default;
    runner(const runner&) = delete;
    runner& operator=(const runner&) = delete;
    virtual ~runner() = default;

    // "cpu", "gl" or "vk".
    virtual std::string_view backend() const = 0;
    // What computes: a width and a number of threads, or the name of a device.
    virtual std::string device() const = 0;
    // How: "8 lanes (AVX2)", "fragment, text", ...
    virtual std::string route() const = 0;
    std::string name() const { return std::string(backend()) + " (" + route() + ")"; }
    // True on processors and software drivers, whose results are the reference's, bit for bit.
    virtual bool exact() const = 0;

    // Compiles for these settings and facts and makes the pictures.
    virtual ao::result<success> prepare(const settings& chosen, const facts& known, const camera& view) = 0;
    // Keeps the pictures. Precondition for this and what follows: prepare succeeded.
    virtual ao::result<success> set_camera(const camera& view) = 0;
    // `normal` is not looked at where facts::normals is from_depth. Fails for pictures of another size or format.
    virtual ao::result<success> upload(const picture& depth, const picture& normal) = 0;
    // Runs a frame to its end; milliseconds per pass, by the device's clock where it has one.
    virtual ao::result<std::vector<pass_time>> frame() = 0;
    virtual ao::result<picture> download() = 0;
    // Of prepare and the first frame after it, as the caller waited for them.
    double first_frame_ms() const { return first_frame_ms_; }

    // The frame of these pictures: prepare, upload, frame, download.
    ao::result<picture> run(const settings& chosen, const facts& known, const camera& view, const picture& depth,
                            const picture& normal);
    // out[i] = ao_evaluate(function, a[i], b[i]), computed where the passes are.
    virtual ao::result<success> evaluate(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b,
                                         std::span<glm::vec4> out) = 0;
    // What a validation layer has said so far.
    virtual std::vector<std::string> messages() const { return {}; }

protected:
    // Whether pictures fit facts; names the one that does not.
    static ao::result<success> check_inputs(const facts& known, const picture& depth, const picture& normal);

    double first_frame_ms_ = 0;
    bool first_frame_ = false; // the next one is
};

using runner_ptr = std::unique_ptr<runner>;

#ifdef AO_HAS_CPU
ao::result<runner_ptr> make_cpu_runner(const cpu::options& o = {});
#endif
#ifdef AO_HAS_GL
ao::result<runner_ptr> make_gl_runner(const gl_options& context = {}, const gl::options& o = {});
// The context that `--device` names: OSMesa's for llvmpipe or nothing, else one from EGL.
gl_options gl_context_of(const std::string& device);
#endif
#ifdef AO_HAS_VK
struct vk_runner_options {
    std::string device; // part of its name; empty: lavapipe
    bool validation = false;
    vk::group_size group{};
};
ao::result<runner_ptr> make_vk_runner(const vk_runner_options& o = {});
// What a device of this program lends to the backend, with what was switched on.
vk::context vk_context_of(const vulkan_device& device, vk::group_size group = {});
#endif

// What `--backend`, `--device` and `--route` name.
// backend: cpu, gl, vk or all. device: part of a GL or Vulkan device's name, letter case ignored; empty: the software driver;
// any other for gl asks EGL. route: empty for the usual one (for `all` every one), else cpu: scalar, lanes4, lanes8, lanes16;
// gl: compute, fragment; vk: compute.
ao::result<std::vector<runner_ptr>> make_runners(std::string_view backend, const std::string& device = {},
                                                 std::string_view route = {});

} // namespace ao::host
