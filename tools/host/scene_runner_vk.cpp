#include "ao/vk/rasterizer.hpp"
#include "ao/vk/shading.hpp"
#include "host/scene_runner_with.hpp"
#include "host/vulkan_device.hpp"
#include "host/vulkan_timer.hpp"

namespace ao::host {

namespace {

error device_error(const std::string& reason)
{
    return error(errc::device, reason);
}

VkImageLayout layout_of(pixel_format format, picture_use use)
{
    switch (use) {
    case picture_use::target:
        return is_depth(format) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    case picture_use::read:
        return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    case picture_use::written:
        break;
    }
    return VK_IMAGE_LAYOUT_GENERAL;
}

class vk_host {
public:
    using rasterizer = vk::rasterizer;
    using shading = vk::shading;
    using texture = vulkan_image;
    using image = vk::image;

    vk_host(std::unique_ptr<vulkan_device> device, vulkan_timer timer, vk::rasterizer drawing, vk::shading shader)
        : device_(std::move(device)),
          timer_(std::move(timer)),
          drawing_(std::move(drawing)),
          shader_(std::move(shader))
    {
    }

    std::string_view backend() const { return "vk"; }
    std::string device() const { return std::string(device_->name()); }
    std::string route() const { return "graphics, compute"; }
    // As vk_runner's.
    bool exact() const
    {
        return device_->properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU && device_->name().starts_with("llvmpipe");
    }
    std::vector<std::string> messages() const { return device_->messages(); }
    vk::rasterizer& drawing() { return drawing_; }
    vk::shading& shader() { return shader_; }
    draw_counts counts(const vk::raster_model& m) const
    {
        draw_counts c;
        c.programs = m.programs();
        c.calls = m.draw_calls();
        return c;
    }

    ao::result<success> enter() { return success{}; }
    ao::result<vulkan_image> make(pixel_format format, int width, int height)
    {
        auto made = vulkan_image::create(*device_, format, { static_cast<unsigned>(width), static_cast<unsigned>(height) });
        if (!made) {
            return device_error(made.reason());
        }
        return std::move(*made);
    }
    ao::result<success> upload(vulkan_image& to, const picture& from) { return as_ours(to.upload(from.bytes)); }
    ao::result<success> download(vulkan_image& from, picture& to) { return as_ours(from.download(to.bytes)); }
    vk::image image_of(vulkan_image& i, picture_use use) { return { i.view, layout_of(i.format, use) }; }

    template <class Uses, class Record>
    ao::result<double> run(const Uses& uses, const Record& record)
    {
        const auto done = device_->submit([&](VkCommandBuffer commands) {
            timer_.record_reset(commands);
            for (const auto& each : uses) {
                if (each.picture != nullptr) {
                    each.picture->record_transition(commands, layout_of(each.picture->format, each.use));
                }
            }
            timer_.record_mark(commands);
            record(commands);
            timer_.record_mark(commands);
        });
        if (!done) {
            return device_error(done.reason());
        }
        const auto marks = timer_.read();
        if (!marks) {
            return device_error(marks.reason());
        }
        return marks->front();
    }

private:
    static ao::result<success> as_ours(const host::result<done>& r)
    {
        if (!r) {
            return device_error(r.reason());
        }
        return success{};
    }

    std::unique_ptr<vulkan_device> device_;
    vulkan_timer timer_;
    vk::rasterizer drawing_;
    vk::shading shader_;
};

} // namespace

ao::result<scene_runner_ptr> make_vk_scene_runner(const vk_runner_options& o)
{
    auto device = vulkan_device::create({ o.device, o.validation });
    if (!device) {
        return device_error(device.reason());
    }
    auto timer = vulkan_timer::create(**device, 2);
    if (!timer) {
        return device_error(timer.reason());
    }
    const vk::context context = vk_context_of(**device, o.group);
    auto drawing = vk::rasterizer::create(context);
    if (!drawing) {
        return drawing.error();
    }
    auto shader = vk::shading::create(context);
    if (!shader) {
        return shader.error();
    }
    return scene_runner_ptr(std::make_unique<scene_runner_with<vk_host>>(
        vk_host(std::move(*device), std::move(*timer), std::move(*drawing), std::move(*shader))));
}

} // namespace ao::host
