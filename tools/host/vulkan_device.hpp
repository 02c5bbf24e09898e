#pragma once
#include "host/pixel_format.hpp"
#include "host/result.hpp"

#include <vulkan/vulkan.h>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ao::host {
struct vulkan_options {
    // Part of the device's name, letter case ignored. Empty: the CPU device (lavapipe), or else the first one.
    std::string device;
    // The validation layer with synchronisation validation. A missing layer is a failure, not a silent no.
    bool validation = false;
    // What Vulkan 1.1 has as an extension or an optional feature of drawing, where the device offers it: dynamic rendering,
    // extended dynamic state, indirect draws of several and of instances from anywhere.
    bool drawing_features = true;
};

class vulkan_messages;

// Instance, device and one queue for graphics and compute. Everything made from it must go before it.
class vulkan_device {
public:
    static result<std::unique_ptr<vulkan_device>> create(const vulkan_options& options = {});
    ~vulkan_device();
    vulkan_device(const vulkan_device&) = delete;
    vulkan_device& operator=(const vulkan_device&) = delete;

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t queue_family = 0;
    VkPhysicalDeviceProperties properties{};
    // What was switched on; only what the device has.
    VkPhysicalDeviceFeatures features{};
    bool dynamic_rendering = false;      // VK_KHR_dynamic_rendering
    bool extended_dynamic_state = false; // VK_EXT_extended_dynamic_state

    std::string_view name() const { return properties.deviceName; }

    // Warnings and errors of the layers since creation, one line each. Empty unless validation is on.
    std::vector<std::string> messages() const;

    // Records once, submits, and waits until the queue has finished.
    result<done> submit(const std::function<void(VkCommandBuffer)>& record);

    // Index of a memory type among `allowed` that has all `wanted` flags; negative when there is none.
    int memory_type(uint32_t allowed, VkMemoryPropertyFlags wanted) const;

private:
    vulkan_device() = default;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::unique_ptr<vulkan_messages> messages_;
};

// The names of all devices, in the driver's order.
result<std::vector<std::string>> vulkan_device_names();

class vulkan_buffer {
public:
    // Host-visible and coherent, mapped for its whole life.
    static result<vulkan_buffer> create(vulkan_device& device, VkDeviceSize size, VkBufferUsageFlags usage);
    vulkan_buffer(vulkan_buffer&& other) noexcept { *this = std::move(other); }
    vulkan_buffer& operator=(vulkan_buffer&& other) noexcept;
    ~vulkan_buffer();

    VkBuffer buffer = VK_NULL_HANDLE;
    std::span<std::byte> bytes;

private:
    vulkan_buffer() = default;
    VkDevice device_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
};

VkFormat vulkan_format(pixel_format format);

// A 2-D image with one level and its view (for d24 in whichever of X8_D24 and D24_S8 the device has; the view shows
// depth alone). Usage: transfer, sampled, and storage, colour or depth attachment where the format allows it.
class vulkan_image {
public:
    static result<vulkan_image> create(vulkan_device& device, pixel_format format, extent size);
    vulkan_image(vulkan_image&& other) noexcept { *this = std::move(other); }
    vulkan_image& operator=(vulkan_image&& other) noexcept;
    ~vulkan_image();

    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkFormat vk_format = VK_FORMAT_UNDEFINED;
    VkImageUsageFlags usage = 0;
    pixel_format format = pixel_format::r32f;
    extent size;
    // The layout between submissions; whoever changes it in a command buffer of its own says so here.
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;

    VkImageAspectFlags aspects() const;

    // Rows in memory order, no flip. The image ends in `after`.
    result<done> upload(std::span<const std::byte> pixels, VkImageLayout after = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    // Keeps the layout; the image must have been written.
    result<done> download(std::span<std::byte> pixels);
    // Waits for everything before and holds up everything after; keeps the content.
    void record_transition(VkCommandBuffer commands, VkImageLayout after);
    result<done> transition(VkImageLayout after);

private:
    vulkan_image() = default;
    vulkan_device* owner_ = nullptr;
    VkDevice device_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
};
}
