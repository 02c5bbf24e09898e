#include "host/temporal_runner.hpp"

#include "ao/vk/temporal.hpp"
#include "host/vulkan_device.hpp"
#include "host/vulkan_timer.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace ao::host {

namespace {

error device_error(const std::string& reason)
{
    return error(errc::device, reason);
}

class vk_temporal_runner final : public temporal_runner {
public:
    vk_temporal_runner(std::unique_ptr<vulkan_device> device, vulkan_timer timer, vk::temporal executor, vk::group_size group)
        : device_(std::move(device)),
          timer_(std::move(timer)),
          executor_(std::move(executor)),
          group_(group)
    {
    }

    std::string_view backend() const override { return "vk"; }
    std::string device() const override { return std::string(device_->name()); }
    std::string route() const override
    {
        return group_.x == 0 ? "compute" : "compute, groups of " + std::to_string(group_.x) + "x" + std::to_string(group_.y);
    }
    // As vk_runner's.
    bool exact() const override
    {
        return device_->properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU && device_->name().starts_with("llvmpipe");
    }
    std::vector<std::string> messages() const override { return device_->messages(); }

    ao::result<success> prepare(const temporal_settings& s, const temporal_facts& f) override
    {
        bound_.reset();
        program_.reset();
        const auto planned = make_temporal_plan(s, f);
        if (!planned) {
            return planned.error();
        }
        auto program = executor_.prepare_temporal(*planned);
        if (!program) {
            return program.error();
        }
        plan_ = *planned;
        state_ = {};
        program_.emplace(std::move(*program));
        if (const auto made = make_pictures(); !made) {
            return made;
        }
        const auto handle = [](const std::optional<vulkan_image>& i) {
            return i ? vk::image{ i->view, i->layout } : vk::image{};
        };
        auto bound =
            executor_.bind_temporal(*program_, plan_, { handle(depth_), handle(normal_), handle(motion_), handle(visibility_) });
        if (!bound) {
            return bound.error();
        }
        bound_.emplace(std::move(*bound));
        auto staging = vulkan_buffer::create(*device_, history_bytes(plan_),
                                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        if (!staging) {
            return device_error(staging.reason());
        }
        staging_.emplace(std::move(*staging));
        return success{};
    }

    ao::result<success> upload(const picture& depth, const picture& normal, const picture& motion) override
    {
        if (const auto fits = check_inputs(plan_.facts, depth, normal, motion); !fits) {
            return fits;
        }
        const std::array<std::pair<std::optional<vulkan_image>*, const picture*>, 3> all{
            { { &depth_, &depth }, { &normal_, &normal }, { &motion_, &motion } }
        };
        for (const auto& [to, from] : all) {
            if (*to) {
                if (const auto done = (*to)->upload(from->bytes); !done) {
                    return device_error(done.reason());
                }
            }
        }
        return success{};
    }

    ao::result<std::vector<temporal_pass_time>> frame(const temporal_camera& view, bool cut) override
    {
        const auto next = next_frame(plan_, state_, view, cut);
        if (!next) {
            return next.error();
        }
        std::vector<temporal_pass_time> times;
        if (next->steps.size() == 0) {
            return times;
        }
        const auto done = device_->submit([&](VkCommandBuffer commands) {
            timer_.record_reset(commands);
            timer_.record_mark(commands);
            for (std::size_t i = 0; i < next->steps.size(); ++i) {
                executor_.record_temporal(commands, *program_, *bound_, plan_, *next, i);
                timer_.record_mark(commands);
            }
        });
        if (!done) {
            return device_error(done.reason());
        }
        const auto marks = timer_.read();
        if (!marks) {
            return device_error(marks.reason());
        }
        for (std::size_t i = 0; i < next->steps.size(); ++i) {
            times.push_back({ plan_.steps[next->steps[i]].type, (*marks)[i] });
        }
        return times;
    }

    ao::result<picture> download() override
    {
        const facts& f = plan_.facts.frame;
        picture read(f.output_format, f.width, f.height);
        if (const auto done = visibility_->download(read.bytes); !done) {
            return device_error(done.reason());
        }
        return read;
    }

    ao::result<std::vector<std::uint32_t>> history() override
    {
        if (const auto done = copy_history(program_->history(state_.latest), staging_->buffer); !done) {
            return done.error();
        }
        std::vector<std::uint32_t> words(history_bytes(plan_) / sizeof(std::uint32_t));
        std::copy(staging_->bytes.begin(), staging_->bytes.end(), std::as_writable_bytes(std::span(words)).begin());
        return words;
    }

    ao::result<success> set_history(std::span<const std::uint32_t> words) override
    {
        const auto bytes = std::as_bytes(words);
        if (bytes.size() != history_bytes(plan_)) {
            return error(errc::invalid_size, "the history has another size than the plan's");
        }
        std::copy(bytes.begin(), bytes.end(), staging_->bytes.begin());
        return copy_history(staging_->buffer, program_->history(state_.latest));
    }

    const temporal_plan& plan() const override { return plan_; }

private:
    ao::result<success> make_pictures()
    {
        const temporal_facts& f = plan_.facts;
        constexpr VkImageLayout read = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        struct part {
            std::optional<vulkan_image>& image;
            bool wanted;
            pixel_format format;
            VkImageLayout layout;
        };
        for (const part& each : { part{ depth_, true, f.frame.depth_format, read },
                                  part{ normal_, f.frame.normals != normal_source::from_depth, f.frame.normal_format, read },
                                  part{ motion_, f.motion, f.motion_format, read },
                                  part{ visibility_, true, f.frame.output_format, VK_IMAGE_LAYOUT_GENERAL } }) {
            each.image.reset();
            if (!each.wanted) {
                continue;
            }
            auto made = vulkan_image::create(*device_, each.format,
                                             { static_cast<unsigned>(f.frame.width), static_cast<unsigned>(f.frame.height) });
            if (!made) {
                return device_error(made.reason());
            }
            if (const auto done = made->transition(each.layout); !done) {
                return device_error(done.reason());
            }
            each.image.emplace(std::move(*made));
        }
        return success{};
    }

    ao::result<success> copy_history(VkBuffer from, VkBuffer to)
    {
        const auto done = device_->submit([&](VkCommandBuffer commands) {
            VkMemoryBarrier memory{};
            memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
            memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
            memory.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
            vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                                 VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &memory, 0, nullptr, 0, nullptr);
            const VkBufferCopy all{ 0, 0, history_bytes(plan_) };
            vkCmdCopyBuffer(commands, from, to, 1, &all);
            memory.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
            memory.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
            vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &memory, 0, nullptr,
                                 0, nullptr);
        });
        if (!done) {
            return device_error(done.reason());
        }
        return success{};
    }

    std::unique_ptr<vulkan_device> device_;
    vulkan_timer timer_;
    vk::temporal executor_;
    vk::group_size group_;
    std::optional<vulkan_image> depth_;
    std::optional<vulkan_image> normal_;
    std::optional<vulkan_image> motion_;
    std::optional<vulkan_image> visibility_;
    std::optional<vulkan_buffer> staging_;
    temporal_plan plan_;
    temporal_state state_;
    std::optional<vk::temporal_program> program_;
    std::optional<vk::temporal_binding> bound_;
};

} // namespace

ao::result<temporal_runner_ptr> make_vk_temporal_runner(const vk_runner_options& o)
{
    auto device = vulkan_device::create({ o.device, o.validation });
    if (!device) {
        return device_error(device.reason());
    }
    // A frame has five steps at most.
    auto timer = vulkan_timer::create(**device, 6);
    if (!timer) {
        return device_error(timer.reason());
    }
    auto executor = vk::temporal::create(vk_context_of(**device, o.group));
    if (!executor) {
        return executor.error();
    }
    return temporal_runner_ptr(
        std::make_unique<vk_temporal_runner>(std::move(*device), std::move(*timer), std::move(*executor), o.group));
}

} // namespace ao::host
