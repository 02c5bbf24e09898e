#include "ao/cpu/rasterizer.hpp"
#include "ao/cpu/shading.hpp"
#include "host/scene_runner_with.hpp"

#include <algorithm>
#include <chrono>

namespace ao::host {

namespace {

class cpu_host {
public:
    using rasterizer = cpu::rasterizer;
    using shading = cpu::shading;
    using texture = picture;
    using image = cpu::image_view;

    cpu_host(cpu::rasterizer drawing, cpu::shading shader, int threads)
        : drawing_(std::move(drawing)),
          shader_(std::move(shader)),
          threads_(threads)
    {
    }

    std::string_view backend() const { return "cpu"; }
    std::string device() const { return std::to_string(threads_) + (threads_ == 1 ? " thread" : " threads"); }
    std::string route() const { return "tiles"; }
    bool exact() const { return true; }
    std::vector<std::string> messages() const { return {}; }
    cpu::rasterizer& drawing() { return drawing_; }
    cpu::shading& shader() { return shader_; }
    // No driver, so no programs and no calls of one.
    draw_counts counts(const cpu::raster_model&) const { return {}; }

    ao::result<success> enter() { return success{}; }
    ao::result<picture> make(pixel_format format, int width, int height) { return picture(format, width, height); }
    // Into the bytes that are bound.
    ao::result<success> upload(picture& to, const picture& from)
    {
        std::copy(from.bytes.begin(), from.bytes.end(), to.bytes.begin());
        return success{};
    }
    ao::result<success> download(const picture& from, picture& to)
    {
        to = from;
        return success{};
    }
    cpu::image_view image_of(picture& p, picture_use) { return cpu::view_of(p); }

    template <class Uses, class Record>
    ao::result<double> run(const Uses&, const Record& record)
    {
        const auto start = std::chrono::steady_clock::now();
        record(cpu::commands{});
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }

private:
    cpu::rasterizer drawing_;
    cpu::shading shader_;
    int threads_;
};

} // namespace

ao::result<scene_runner_ptr> make_cpu_scene_runner(const cpu::options& o)
{
    const auto chosen = cpu::backend::create(o);
    if (!chosen) {
        return chosen.error();
    }
    auto drawing = cpu::rasterizer::create(o);
    if (!drawing) {
        return drawing.error();
    }
    auto shader = cpu::shading::create(o);
    if (!shader) {
        return shader.error();
    }
    return scene_runner_ptr(
        std::make_unique<scene_runner_with<cpu_host>>(cpu_host(std::move(*drawing), std::move(*shader), chosen->threads())));
}

} // namespace ao::host
