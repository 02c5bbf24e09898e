// A plan run on a Vulkan device: pictures in memory in, visibility out.
#pragma once

#include "ao/picture.hpp"
#include "ao/vk/backend.hpp"
#include "host/vulkan_device.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

namespace vk_runner {

// Which of the backend's shaders run: those for the device's type, or those for a GPU on whatever device.
enum class shaders { of_device, of_gpu };

inline void VKAPI_PTR gpu_properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties)
{
    vkGetPhysicalDeviceProperties(device, properties);
    properties->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
}

inline PFN_vkVoidFunction VKAPI_PTR gpu_loader(VkInstance instance, const char* name)
{
    if (std::strcmp(name, "vkGetPhysicalDeviceProperties") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(gpu_properties);
    }
    return vkGetInstanceProcAddr(instance, name);
}

inline ao::vk::context context_of(ao::host::vulkan_device& device, ao::vk::group_size group = {},
                                  shaders which = shaders::of_device)
{
    ao::vk::context c;
    c.instance = device.instance;
    c.physical_device = device.physical;
    c.device = device.device;
    c.get_instance_proc_addr = which == shaders::of_gpu ? gpu_loader : vkGetInstanceProcAddr;
    c.group = group;
    return c;
}

inline ao::host::vulkan_image upload(ao::host::vulkan_device& device, const ao::picture& p, VkImageLayout layout)
{
    auto image =
        ao::host::vulkan_image::create(device, p.format, { static_cast<unsigned>(p.width), static_cast<unsigned>(p.height) });
    if (!image || !image->upload(p.bytes, layout)) {
        std::abort();
    }
    return std::move(*image);
}

// The visibility, or an empty picture and the reason.
struct outcome {
    ao::picture visibility;
    std::string reason;
};

inline outcome run(ao::host::vulkan_device& device, const ao::settings& s, const ao::facts& f, const ao::camera& view,
                   const ao::picture& depth, const ao::picture& normal, ao::vk::group_size group = {},
                   shaders which = shaders::of_device)
{
    auto backend = ao::vk::backend::create(context_of(device, group, which));
    if (!backend) {
        return { {}, std::string(backend.error().reason()) };
    }
    auto effect = ao::effect<ao::vk::backend>::create(*backend, s, f, view);
    if (!effect) {
        return { {}, std::string(effect.error().reason()) };
    }
    const auto depth_image = upload(device, depth, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    const bool has_normals = f.normals != ao::normal_source::from_depth;
    std::optional<ao::host::vulkan_image> normal_image;
    if (has_normals) {
        normal_image = upload(device, normal, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    }
    ao::picture visibility(f.output_format, f.width, f.height);
    std::fill(visibility.bytes.begin(), visibility.bytes.end(), std::byte{ 0x3e });
    auto visibility_image = upload(device, visibility, VK_IMAGE_LAYOUT_GENERAL);

    auto bound = effect->bind({ { depth_image.view, depth_image.layout },
                                { has_normals ? normal_image->view : VK_NULL_HANDLE, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL },
                                { visibility_image.view, VK_IMAGE_LAYOUT_GENERAL } });
    if (!bound) {
        return { {}, std::string(bound.error().reason()) };
    }
    if (const auto done = device.submit([&](VkCommandBuffer commands) { effect->record(commands, *bound); }); !done) {
        return { {}, done.reason() };
    }
    if (const auto done = visibility_image.download(visibility.bytes); !done) {
        return { {}, done.reason() };
    }
    return { visibility, {} };
}

} // namespace vk_runner
