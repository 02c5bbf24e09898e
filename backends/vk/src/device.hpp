// The host's device and the entry points that the backend uses.
#pragma once

#include "ao/vk/backend.hpp"

#include <utility>

#define AO_VK_INSTANCE_FUNCTIONS(X)                                                                                              \
    X(GetDeviceProcAddr)                                                                                                         \
    X(GetPhysicalDeviceProperties)                                                                                               \
    X(GetPhysicalDeviceFeatures)                                                                                                 \
    X(GetPhysicalDeviceFormatProperties)                                                                                         \
    X(GetPhysicalDeviceMemoryProperties)

#define AO_VK_DEVICE_FUNCTIONS(X)                                                                                                \
    X(AllocateDescriptorSets)                                                                                                    \
    X(AllocateMemory)                                                                                                            \
    X(BindBufferMemory)                                                                                                          \
    X(BindImageMemory)                                                                                                           \
    X(CmdBeginRenderPass)                                                                                                        \
    X(CmdBindDescriptorSets)                                                                                                     \
    X(CmdBindIndexBuffer)                                                                                                        \
    X(CmdBindPipeline)                                                                                                           \
    X(CmdBindVertexBuffers)                                                                                                      \
    X(CmdCopyBuffer)                                                                                                             \
    X(CmdCopyBufferToImage)                                                                                                      \
    X(CmdDispatch)                                                                                                               \
    X(CmdDispatchIndirect)                                                                                                       \
    X(CmdDrawIndexed)                                                                                                            \
    X(CmdDrawIndexedIndirect)                                                                                                    \
    X(CmdEndRenderPass)                                                                                                          \
    X(CmdFillBuffer)                                                                                                             \
    X(CmdPipelineBarrier)                                                                                                        \
    X(CmdPushConstants)                                                                                                          \
    X(CmdUpdateBuffer)                                                                                                           \
    X(CreateBuffer)                                                                                                              \
    X(CreateBufferView)                                                                                                          \
    X(CreateComputePipelines)                                                                                                    \
    X(CreateDescriptorPool)                                                                                                      \
    X(CreateDescriptorSetLayout)                                                                                                 \
    X(CreateFramebuffer)                                                                                                         \
    X(CreateGraphicsPipelines)                                                                                                   \
    X(CreateImage)                                                                                                               \
    X(CreateImageView)                                                                                                           \
    X(CreatePipelineLayout)                                                                                                      \
    X(CreateRenderPass)                                                                                                          \
    X(CreateSampler)                                                                                                             \
    X(CreateShaderModule)                                                                                                        \
    X(DestroyBuffer)                                                                                                             \
    X(DestroyBufferView)                                                                                                         \
    X(DestroyDescriptorPool)                                                                                                     \
    X(DestroyDescriptorSetLayout)                                                                                                \
    X(DestroyFramebuffer)                                                                                                        \
    X(DestroyImage)                                                                                                              \
    X(DestroyImageView)                                                                                                          \
    X(DestroyPipeline)                                                                                                           \
    X(DestroyPipelineLayout)                                                                                                     \
    X(DestroyRenderPass)                                                                                                         \
    X(DestroySampler)                                                                                                            \
    X(DestroyShaderModule)                                                                                                       \
    X(FreeMemory)                                                                                                                \
    X(GetBufferMemoryRequirements)                                                                                               \
    X(GetImageMemoryRequirements)                                                                                                \
    X(MapMemory)                                                                                                                 \
    X(UnmapMemory)                                                                                                               \
    X(UpdateDescriptorSets)

// Of what context::enabled names: an extension's entry points, or those of the version that it became part of.
#define AO_VK_OPTIONAL_FUNCTIONS(X)                                                                                              \
    X(CmdBeginRendering, KHR, dynamic_rendering)                                                                                 \
    X(CmdEndRendering, KHR, dynamic_rendering)                                                                                   \
    X(CmdSetCullMode, EXT, extended_dynamic_state)                                                                               \
    X(CmdSetDepthCompareOp, EXT, extended_dynamic_state)                                                                         \
    X(CmdSetFrontFace, EXT, extended_dynamic_state)

namespace ao::vk {

struct functions {
#define AO_VK_MEMBER(name, ...) PFN_vk##name name = nullptr;
    AO_VK_INSTANCE_FUNCTIONS(AO_VK_MEMBER)
    AO_VK_DEVICE_FUNCTIONS(AO_VK_MEMBER)
    AO_VK_OPTIONAL_FUNCTIONS(AO_VK_MEMBER)
#undef AO_VK_MEMBER
};

struct device {
    context host;
    functions call;
    VkPhysicalDeviceProperties properties{};
    VkPhysicalDeviceFeatures features{};
    VkPhysicalDeviceMemoryProperties memory{};
};

// Loads the entry points and checks what the host said; group_size is settled.
result<std::unique_ptr<device>> make_device(const context& c);

// On a device that is a CPU (lavapipe) the passes read the program's own pictures as storage images, and host depth that the
// occlusion would read directly is copied into one first.
bool is_software(const device& d);

// A child of a VkDevice, destroyed with its owner.
template <class Handle>
class owned {
public:
    using destroy_function = void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*);

    owned() = default;
    owned(VkDevice device, Handle handle, destroy_function destroy) : device_(device), handle_(handle), destroy_(destroy) {}
    owned(owned&& other) noexcept { *this = std::move(other); }
    owned& operator=(owned&& other) noexcept
    {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        std::swap(destroy_, other.destroy_);
        return *this;
    }
    ~owned()
    {
        if (handle_ != VK_NULL_HANDLE) {
            destroy_(device_, handle_, nullptr);
        }
    }
    Handle get() const { return handle_; }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    Handle handle_ = VK_NULL_HANDLE;
    destroy_function destroy_ = nullptr;
};

// `what` is the name of the function that returned `code`.
error api_error(VkResult code, const char* what);

template <class Handle, class Info, class Create>
result<owned<Handle>> create(const device& d, Create create_function, typename owned<Handle>::destroy_function destroy,
                             const Info& info, const char* what)
{
    Handle handle = VK_NULL_HANDLE;
    if (const VkResult code = create_function(d.host.device, &info, nullptr, &handle); code != VK_SUCCESS) {
        return api_error(code, what);
    }
    return owned<Handle>(d.host.device, handle, destroy);
}

// Creates `target` by vkCreate<type>, or returns the error from the calling function.
#define AO_VK_CREATE(target, d, type, info)                                                                                      \
    do {                                                                                                                         \
        auto created_ = ao::vk::create<Vk##type>(d, (d).call.Create##type, (d).call.Destroy##type, info, "vkCreate" #type);      \
        if (!created_) {                                                                                                         \
            return created_.error();                                                                                             \
        }                                                                                                                        \
        (target) = std::move(*created_);                                                                                         \
    } while (false)

} // namespace ao::vk
