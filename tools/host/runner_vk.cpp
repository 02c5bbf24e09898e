#include "host/runner.hpp"

#include "ao/vk/backend.hpp"
#include "host/runner_vk_evaluate.hpp"
#include "host/vulkan_device.hpp"
#include "host/vulkan_timer.hpp"

#include <chrono>
#include <optional>
#include <utility>

namespace ao::host {

namespace {

using clock = std::chrono::steady_clock;
using vk_effect = effect<vk::backend>;

error device_error(const std::string& reason)
{
    return error(errc::device, reason);
}

class vk_runner final : public runner {
public:
    vk_runner(std::unique_ptr<vulkan_device> device, vk::backend b, vk::group_size group)
        : device_(std::move(device)),
          backend_(std::move(b)),
          group_(group)
    {
    }

    std::string_view backend() const override { return "vk"; }
    std::string device() const override { return std::string(device_->name()); }
    std::string route() const override
    {
        // 0x0 leaves the size to the backend.
        return group_.x == 0 ? "compute" : "compute, groups of " + std::to_string(group_.x) + "x" + std::to_string(group_.y);
    }
    // Of the devices that are processors lavapipe alone was measured; any other is held to the bounds.
    bool exact() const override
    {
        return device_->properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU && device_->name().starts_with("llvmpipe");
    }

    ao::result<success> prepare(const settings& chosen, const facts& known, const camera& view) override
    {
        const auto start = clock::now();
        bound_.reset();
        auto made = vk_effect::create(backend_, chosen, known, view);
        if (!made) {
            return made.error();
        }
        effect_.emplace(std::move(*made));
        if (const auto wrong = make(depth_, known, known.depth_format)) {
            return *wrong;
        }
        const bool has_normals = known.normals != normal_source::from_depth;
        normal_.reset();
        if (const auto wrong = has_normals ? make(normal_, known, known.normal_format) : std::nullopt) {
            return *wrong;
        }
        if (const auto wrong = make(visibility_, known, known.output_format)) {
            return *wrong;
        }
        if (const auto done = visibility_->transition(VK_IMAGE_LAYOUT_GENERAL); !done) {
            return device_error(done.reason());
        }
        constexpr VkImageLayout read = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        auto bound = effect_->bind({ { depth_->view, read },
                                     { has_normals ? normal_->view : VK_NULL_HANDLE, read },
                                     { visibility_->view, VK_IMAGE_LAYOUT_GENERAL } });
        if (!bound) {
            return bound.error();
        }
        bound_.emplace(std::move(*bound));
        const std::size_t passes = effect_->current_plan().passes.size();
        auto timer = vulkan_timer::create(*device_, static_cast<std::uint32_t>(passes + 1));
        if (!timer) {
            return device_error(timer.reason());
        }
        timer_.emplace(std::move(*timer));
        first_frame_ms_ = std::chrono::duration<double, std::milli>(clock::now() - start).count();
        first_frame_ = true;
        return success{};
    }

    ao::result<success> set_camera(const camera& view) override
    {
        if (const auto wrong = effect_->set_camera(view)) {
            return *wrong;
        }
        return success{};
    }

    ao::result<success> upload(const picture& depth, const picture& normal) override
    {
        if (const auto fits = check_inputs(effect_->current_plan().facts, depth, normal); !fits) {
            return fits.error();
        }
        if (const auto done = depth_->upload(depth.bytes); !done) {
            return device_error(done.reason());
        }
        if (normal_) {
            if (const auto done = normal_->upload(normal.bytes); !done) {
                return device_error(done.reason());
            }
        }
        return success{};
    }

    ao::result<std::vector<pass_time>> frame() override
    {
        const auto& passes = effect_->current_plan().passes;
        const auto start = clock::now();
        const auto done = device_->submit([&](VkCommandBuffer commands) {
            timer_->record_reset(commands);
            timer_->record_mark(commands);
            for (std::size_t i = 0; i < passes.size(); ++i) {
                effect_->record_pass(commands, *bound_, i);
                timer_->record_mark(commands);
            }
        });
        if (!done) {
            return device_error(done.reason());
        }
        if (first_frame_) {
            first_frame_ms_ += std::chrono::duration<double, std::milli>(clock::now() - start).count();
            first_frame_ = false;
        }
        const auto marks = timer_->read();
        if (!marks) {
            return device_error(marks.reason());
        }
        std::vector<pass_time> times;
        for (std::size_t i = 0; i < passes.size(); ++i) {
            times.push_back({ passes[i].type, (*marks)[i] });
        }
        return times;
    }

    ao::result<picture> download() override
    {
        const facts& known = effect_->current_plan().facts;
        picture read(known.output_format, known.width, known.height);
        if (const auto done = visibility_->download(read.bytes); !done) {
            return device_error(done.reason());
        }
        return read;
    }

    ao::result<success> evaluate(int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b,
                                 std::span<glm::vec4> out) override
    {
        return evaluate_vk(*device_, function, a, b, out);
    }

    std::vector<std::string> messages() const override { return device_->messages(); }

private:
    std::optional<error> make(std::optional<vulkan_image>& image, const facts& known, pixel_format format)
    {
        auto made =
            vulkan_image::create(*device_, format, { static_cast<unsigned>(known.width), static_cast<unsigned>(known.height) });
        if (!made) {
            return device_error(made.reason());
        }
        image.emplace(std::move(*made));
        return std::nullopt;
    }

    std::unique_ptr<vulkan_device> device_;
    vk::backend backend_;
    vk::group_size group_;
    std::optional<vulkan_image> depth_;
    std::optional<vulkan_image> normal_;
    std::optional<vulkan_image> visibility_;
    std::optional<vulkan_timer> timer_;
    std::optional<vk_effect> effect_;
    std::optional<vk_effect::binding> bound_;
};

} // namespace

vk::context vk_context_of(const vulkan_device& device, vk::group_size group)
{
    vk::context c;
    c.instance = device.instance;
    c.physical_device = device.physical;
    c.device = device.device;
    c.get_instance_proc_addr = vkGetInstanceProcAddr;
    c.group = group;
    c.enabled = { device.dynamic_rendering, device.extended_dynamic_state, device.features.multiDrawIndirect == VK_TRUE,
                  device.features.drawIndirectFirstInstance == VK_TRUE };
    return c;
}

ao::result<runner_ptr> make_vk_runner(const vk_runner_options& o)
{
    auto device = vulkan_device::create({ o.device, o.validation });
    if (!device) {
        return device_error(device.reason());
    }
    auto b = vk::backend::create(vk_context_of(**device, o.group));
    if (!b) {
        return b.error();
    }
    return runner_ptr(std::make_unique<vk_runner>(std::move(*device), std::move(*b), o.group));
}

} // namespace ao::host
