#pragma once
#include "host/vulkan_device.hpp"

namespace ao::host {
// Times stretches of a command buffer on the device's own clock.
class vulkan_timer {
public:
    // `marks` points in time, which bound marks - 1 stretches.
    static result<vulkan_timer> create(vulkan_device& device, uint32_t marks);
    vulkan_timer(vulkan_timer&& other) noexcept { *this = std::move(other); }
    vulkan_timer& operator=(vulkan_timer&& other) noexcept;
    ~vulkan_timer();

    // First in a command buffer, outside a render pass.
    void record_reset(VkCommandBuffer commands);
    // When all commands so far have finished.
    void record_mark(VkCommandBuffer commands);
    // Milliseconds between neighbouring marks; the command buffer must have been submitted.
    result<std::vector<double>> read() const;

private:
    vulkan_timer() = default;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueryPool pool_ = VK_NULL_HANDLE;
    uint32_t marks_ = 0;
    uint32_t next_ = 0;
    uint64_t mask_ = 0;
    double period_ns_ = 0;
};
}
