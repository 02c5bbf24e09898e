#include "host/vulkan_messages.hpp"

#include <algorithm>

namespace ao::host {
VkDebugUtilsMessengerCreateInfoEXT vulkan_messages::create_info()
{
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // Not GENERAL: there the loader complains about drivers of other cards that are installed but cannot start.
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = receive;
    info.pUserData = this;
    return info;
}

void vulkan_messages::attach(VkInstance instance)
{
    const auto create =
        reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
    const VkDebugUtilsMessengerCreateInfoEXT info = create_info();
    if (create)
        create(instance, &info, nullptr, &messenger_);
}

void vulkan_messages::detach(VkInstance instance)
{
    const auto destroy =
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
    if (destroy && messenger_)
        destroy(instance, messenger_, nullptr);
    messenger_ = VK_NULL_HANDLE;
}

std::vector<std::string> vulkan_messages::list() const
{
    const std::scoped_lock lock(mutex_);
    return messages_;
}

VkBool32 vulkan_messages::receive(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* user)
{
    auto& self = *static_cast<vulkan_messages*>(user);
    std::string text = data->pMessage ? data->pMessage : "";
    std::replace(text.begin(), text.end(), '\n', ' ');
    const std::scoped_lock lock(self.mutex_);
    self.messages_.push_back(std::move(text));
    return VK_FALSE;
}
}
