// A temporal executor together with a context of its own, pictures and a clock: the counterpart of host/runner.hpp for temporal
// ambient occlusion.
#pragma once

#include "ao/picture.hpp"
#include "ao/result.hpp"
#include "ao/temporal.hpp"
#include "host/runner.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ao::host {

struct temporal_pass_time {
    temporal_pass_type pass{};
    double ms = 0;
};
const char* name(temporal_pass_type pass);

class temporal_runner {
public:
    temporal_runner() = default;
    temporal_runner(const temporal_runner&) = delete;
    temporal_runner& operator=(const temporal_runner&) = delete;
    virtual ~temporal_runner() = default;

    // As runner's.
    virtual std::string_view backend() const = 0;
    virtual std::string device() const = 0;
    virtual std::string route() const = 0;
    std::string name() const { return std::string(backend()) + " (" + route() + ")"; }
    virtual bool exact() const = 0;
    virtual std::vector<std::string> messages() const { return {}; }

    // Compiles for these settings and facts and makes the pictures; the first frame begins anew.
    virtual ao::result<success> prepare(const temporal_settings& s, const temporal_facts& f) = 0;
    // Precondition for this and what follows: prepare succeeded. The pictures of the next frame; normal and motion are not looked
    // at where the facts leave them out. Fails for pictures of another size or format.
    virtual ao::result<success> upload(const picture& depth, const picture& normal, const picture& motion) = 0;
    // Runs a frame to its end; the passes that it ran, none where the picture stands, by the device's clock where it has one.
    // On an error nothing ran and the history stays.
    virtual ao::result<std::vector<temporal_pass_time>> frame(const temporal_camera& view, bool cut = false) = 0;
    // The visibility, in facts::output_format.
    virtual ao::result<picture> download() = 0;
    // Words of the latest history (ao/shared/history.h), pixel after pixel: history_bytes(plan) / 4 of them.
    virtual ao::result<std::vector<std::uint32_t>> history() = 0;
    // In its place, as a fault would.
    virtual ao::result<success> set_history(std::span<const std::uint32_t> words) = 0;
    virtual const temporal_plan& plan() const = 0;

protected:
    static ao::result<success> check_inputs(const temporal_facts& f, const picture& depth, const picture& normal,
                                            const picture& motion);
};

using temporal_runner_ptr = std::unique_ptr<temporal_runner>;

#ifdef AO_HAS_CPU
ao::result<temporal_runner_ptr> make_cpu_temporal_runner(const cpu::options& o = {});
#endif
#ifdef AO_HAS_GL
ao::result<temporal_runner_ptr> make_gl_temporal_runner(const gl_options& context = {}, const gl::options& o = {});
#endif
#ifdef AO_HAS_VK
ao::result<temporal_runner_ptr> make_vk_temporal_runner(const vk_runner_options& o = {});
#endif

// What `--backend` and `--device` name, as make_runners; `all` are those that the program was built with.
ao::result<std::vector<temporal_runner_ptr>> make_temporal_runners(std::string_view backend, const std::string& device = {});

} // namespace ao::host
