#include "device.hpp"

#include <cstdio>
#include <new>

namespace ao::vk {

namespace {

// The first entry point that is missing, or nothing.
const char* load(functions& f, const context& c)
{
#define AO_VK_LOAD(name)                                                                                                         \
    f.name = reinterpret_cast<PFN_vk##name>(c.get_instance_proc_addr(c.instance, "vk" #name));                                   \
    if (f.name == nullptr) {                                                                                                     \
        return "vk" #name;                                                                                                       \
    }
    AO_VK_INSTANCE_FUNCTIONS(AO_VK_LOAD)
#undef AO_VK_LOAD
#define AO_VK_LOAD(name)                                                                                                         \
    f.name = reinterpret_cast<PFN_vk##name>(f.GetDeviceProcAddr(c.device, "vk" #name));                                          \
    if (f.name == nullptr) {                                                                                                     \
        return "vk" #name;                                                                                                       \
    }
    AO_VK_DEVICE_FUNCTIONS(AO_VK_LOAD)
#undef AO_VK_LOAD
#define AO_VK_LOAD(name, suffix, feature)                                                                                        \
    if (c.enabled.feature) {                                                                                                     \
        f.name = reinterpret_cast<PFN_vk##name>(f.GetDeviceProcAddr(c.device, "vk" #name #suffix));                              \
        if (f.name == nullptr) {                                                                                                 \
            f.name = reinterpret_cast<PFN_vk##name>(f.GetDeviceProcAddr(c.device, "vk" #name));                                  \
        }                                                                                                                        \
        if (f.name == nullptr) {                                                                                                 \
            return "vk" #name;                                                                                                   \
        }                                                                                                                        \
    }
    AO_VK_OPTIONAL_FUNCTIONS(AO_VK_LOAD)
#undef AO_VK_LOAD
    return nullptr;
}

} // namespace

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

bool is_software(const device& d)
{
    return d.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

result<std::unique_ptr<device>> make_device(const context& c)
{
    if (c.instance == VK_NULL_HANDLE || c.physical_device == VK_NULL_HANDLE || c.device == VK_NULL_HANDLE ||
        c.get_instance_proc_addr == nullptr) {
        return error(errc::device, "ao::vk::context needs an instance, a physical device, a device and vkGetInstanceProcAddr");
    }
    std::unique_ptr<device> made(new (std::nothrow) device);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }
    made->host = c;
    char text[160];
    if (const char* missing = load(made->call, c)) {
        std::snprintf(text, sizeof text, "the Vulkan loader does not know %s", missing);
        return error(errc::device, text);
    }
    made->call.GetPhysicalDeviceProperties(c.physical_device, &made->properties);
    made->call.GetPhysicalDeviceFeatures(c.physical_device, &made->features);
    made->call.GetPhysicalDeviceMemoryProperties(c.physical_device, &made->memory);
    if (made->properties.apiVersion < VK_API_VERSION_1_1) {
        return error(errc::device, "the Vulkan device lacks Vulkan 1.1");
    }
    const VkPhysicalDeviceLimits& limits = made->properties.limits;
    if (c.group.x == 0 && c.group.y == 0) {
        made->host.group = is_software(*made) ? group_size{ 16, 16 } : group_size{ 8, 8 };
    }
    const group_size group = made->host.group;
    if (group.x == 0 || group.y == 0 || group.x > limits.maxComputeWorkGroupSize[0] ||
        group.y > limits.maxComputeWorkGroupSize[1] || group.x * group.y > limits.maxComputeWorkGroupInvocations) {
        std::snprintf(text, sizeof text, "compute groups of %ux%u: the Vulkan device allows 1x1 to %u invocations", group.x,
                      group.y, limits.maxComputeWorkGroupInvocations);
        return error(errc::invalid_size, text);
    }
    return made;
}

} // namespace ao::vk
