#pragma once
#include <vulkan/vulkan.h>

#include <mutex>
#include <string>
#include <vector>

namespace ao::host {
// What the layers say, from any thread.
class vulkan_messages {
public:
    // To be chained to VkInstanceCreateInfo too, so that creation and destruction of the instance are covered.
    VkDebugUtilsMessengerCreateInfoEXT create_info();
    void attach(VkInstance instance);
    void detach(VkInstance instance);
    std::vector<std::string> list() const;

private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT types,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);

    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};
}
