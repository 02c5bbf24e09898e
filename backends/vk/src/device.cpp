#include "device.hpp"

#include <cstdio>

namespace ao::vk {

error api_error(VkResult code, const char* what)
{
    char text[128];
    const char* name = code == VK_ERROR_OUT_OF_HOST_MEMORY     ? "VK_ERROR_OUT_OF_HOST_MEMORY"
                       : code == VK_ERROR_OUT_OF_DEVICE_MEMORY ? "VK_ERROR_OUT_OF_DEVICE_MEMORY"
                       : code == VK_ERROR_DEVICE_LOST          ? "VK_ERROR_DEVICE_LOST"
                                                               : "an error";
    std::snprintf(text, sizeof text, "%s returned %s (%d)", what, name, static_cast<int>(code));
    const bool memory = code == VK_ERROR_OUT_OF_HOST_MEMORY || code == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return error(memory ? errc::out_of_memory : errc::device, text, static_cast<int>(code));
}

} // namespace ao::vk
