// Ambient occlusion on Vulkan 1.1, as compute passes recorded into a command buffer of the host's.
//
//     auto backend = ao::vk::backend::create({ instance, physical_device, device, vkGetInstanceProcAddr });
//     auto effect = ao::effect<ao::vk::backend>::create(*backend, settings, facts, camera);
//     auto bound = effect->bind({ { depth_view, layout }, { normal_view, layout }, { visibility_view } });
//     ...
//     effect->set_camera(camera);              // every frame
//     effect->record(command_buffer, *bound);
//
// What the pictures are: one level, one layer, one sample, of the plan's size, the view's format as listed, swizzle identity.
//   depth       eye depth > 0 in scene units (R32_SFLOAT), or a depth buffer's values (D32_SFLOAT, X8_D24_UNORM_PACK32,
//               D24_UNORM_S8_UINT or R32_SFLOAT; the view shows the depth aspect alone), or view-space positions
//               (R16G16B16A16_SFLOAT, R32G32B32A32_SFLOAT). Usage SAMPLED.
//   normal      of any length, in view space (right-handed, -Z ahead) or world space: R16G16B16A16_SFLOAT or
//               R32G32B32A32_SFLOAT; * 0.5 + 0.5 in A2B10G10R10_UNORM_PACK32; octahedral * 0.5 + 0.5 in R16G16_UNORM.
//               Usage SAMPLED. Not looked at (may be null) where facts::normals is from_depth.
//   visibility  1 = open, in R32_SFLOAT or R8_UNORM; R16G16B16A16_SFLOAT with bent normals. Usage STORAGE. All is written.
//
// What the host does around record():
//   before  depth and normal are in the layout given to bind() (SHADER_READ_ONLY_OPTIMAL, DEPTH_STENCIL_READ_ONLY_OPTIMAL,
//           GENERAL, …) and their contents visible to SHADER_READ in the COMPUTE_SHADER stage; visibility is in layout GENERAL
//           and whatever used it last is ordered before SHADER_WRITE in the COMPUTE_SHADER stage (from layout UNDEFINED is fine:
//           no content is kept).
//   after   the visibility, still in GENERAL, is visible to SHADER_READ in COMPUTE_SHADER and FRAGMENT_SHADER and to
//   TRANSFER_READ
//           in TRANSFER (see context::readers). Anything else, a layout transition too, takes a barrier from COMPUTE_SHADER,
//           SHADER_WRITE. Writing depth or normal again takes an execution dependency on COMPUTE_SHADER.
// Outside a render pass, on a queue with compute. record() orders the program's own pictures against their use by earlier
// frames in the same queue; frames in flight on several queues need a program each. It changes the bound compute pipeline, the
// compute descriptor set 0 and the push constants, nothing else.
//
// Device features: shaderStorageImageExtendedFormats where a filter runs (RG32_SFLOAT is stored to) or the output is R8_UNORM.
// Memory of a program, bytes per pixel: 4 unless depth is linear, and 12 with a filter (docs/integrating.md: of bitmask others);
// besides, 48 KiB of tables. On devices that are CPUs linear depth takes 4 too.
#pragma once

#include "ao/backend.hpp"

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>

namespace ao::vk {

// Invocations of a compute group: a matter of speed, never of the result. 0 x 0: 8 x 8, and 16 x 16 on devices that are CPUs,
// where it is some 5 % faster.
struct group_size {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

// What of these the host switched on when it created the device; only the rasterizer asks. Without any it draws the same picture
// by render passes, direct draws and more pipelines.
struct enabled_features {
    bool dynamic_rendering = false;            // VK_KHR_dynamic_rendering, or Vulkan 1.3's feature
    bool extended_dynamic_state = false;       // VK_EXT_extended_dynamic_state's feature, or a device of Vulkan 1.3
    bool multi_draw_indirect = false;          // VkPhysicalDeviceFeatures::multiDrawIndirect
    bool draw_indirect_first_instance = false; // VkPhysicalDeviceFeatures::drawIndirectFirstInstance
};

// What the host owns and lends; it outlives the backend and everything made with it.
struct context {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; // optional; prepare() uses it
    group_size group;
    // Stages that what was written is made visible to at the end: some of these three, or 0 where the host's own barrier
    // follows. On a queue without graphics leave FRAGMENT_SHADER out.
    VkPipelineStageFlags readers =
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    enabled_features enabled;
};

struct image {
    VkImageView view = VK_NULL_HANDLE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL; // while the passes run; for the visibility it is GENERAL
};

struct device;
struct prepared;
struct bound;

class program {
public:
    explicit program(std::unique_ptr<prepared> p);
    program(program&&) noexcept;
    program& operator=(program&&) noexcept;
    ~program();

private:
    friend class backend;
    std::unique_ptr<prepared> prepared_;
};

class binding {
public:
    explicit binding(std::unique_ptr<bound> b);
    binding(binding&&) noexcept;
    binding& operator=(binding&&) noexcept;
    ~binding();

private:
    friend class backend;
    std::unique_ptr<bound> bound_;
};

// fulfils ao::backend. One thread at a time per object; a binding is used with its own program, which outlives it.
class backend {
public:
    using image = vk::image;
    using commands = VkCommandBuffer;
    using program = vk::program;
    using binding = vk::binding;

    static result<backend> create(const context& c);
    backend(backend&&) noexcept;
    backend& operator=(backend&&) noexcept;
    ~backend();

    // unsupported_format, invalid_size: the device cannot do what the plan asks for.
    result<program> prepare(const plan& p);
    // The views must outlive the binding's use. plan_mismatch: the program is for plans of another structure.
    result<binding> bind(program& p, const plan& current, const host_images<image>& images);
    // Only records: no allocation, no lock, no failure.
    void record_pass(VkCommandBuffer commands, program& p, binding& b, const plan& current, std::size_t index);

private:
    explicit backend(std::unique_ptr<device> d);
    std::unique_ptr<device> device_;
};

static_assert(ao::backend<backend>);

} // namespace ao::vk
