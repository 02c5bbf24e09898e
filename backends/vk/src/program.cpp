#include "program.hpp"

#include "ao_vk_shaders.hpp"

#include <cstdio>
#include <new>

namespace ao::vk {

namespace {

const char* name(pixel_format format)
{
    constexpr const char* names[] = { "r32f", "rg32f", "rgba16f", "rgba32f", "rgb10a2", "rg16", "d32f", "d24", "r8" };
    return names[static_cast<int>(format)];
}

bool has(const device& d, VkFormat format, VkFormatFeatureFlags wanted)
{
    VkFormatProperties properties{};
    d.call.GetPhysicalDeviceFormatProperties(d.host.physical_device, format, &properties);
    return (properties.optimalTilingFeatures & wanted) == wanted;
}

bool can_sample(const device& d, pixel_format format)
{
    return has(d, native_format(format), VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) ||
           (format == pixel_format::d24 && has(d, VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT));
}

bool can_store(const device& d, pixel_format format)
{
    const bool base = format == pixel_format::r32f;
    return has(d, native_format(format), VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) &&
           (base || d.features.shaderStorageImageExtendedFormats != VK_FALSE);
}

error lacks(const char* what, pixel_format format)
{
    char text[128];
    std::snprintf(text, sizeof text, "the Vulkan device cannot %s %s pictures", what, name(format));
    return error(errc::unsupported_format, text);
}

// The builds of one source: for storing to r32f and r8, for GPUs and for CPUs.
struct shader_family {
    std::span<const std::uint32_t> plain, r8, software, software_r8;
};

std::span<const std::uint32_t> shader_of(const device& d, const pass& each, const plan& p)
{
    using namespace shaders;
    const bool r8 = each.output == image_id::visibility && p.facts.output_format == pixel_format::r8;
    const auto pick = [&](const shader_family& f) {
        return is_software(d) ? (r8 ? f.software_r8 : f.software) : (r8 ? f.r8 : f.plain);
    };
    switch (each.type) {
    case pass_type::linearize:
        return linearize_comp;
    case pass_type::occlusion:
        return pick({ occlusion_comp, occlusion_comp_r8, occlusion_comp_software, occlusion_comp_software_r8 });
    case pass_type::filter_rows:
        return is_software(d) ? filter_rows_comp_software : filter_rows_comp;
    case pass_type::filter_columns:
        return pick(
            { filter_columns_comp, filter_columns_comp_r8, filter_columns_comp_software, filter_columns_comp_software_r8 });
    }
    return {};
}

// Specialisation constants by their ids in shaders/resources.glsl.
struct specialisation {
    std::array<std::uint32_t, 11> values{};
    std::array<VkSpecializationMapEntry, 11> entries{};
    VkSpecializationInfo info{};

    specialisation(const pass_options& o, bool depth_in_z, group_size group)
    {
        constexpr std::array<std::uint32_t, 11> ids{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 11 };
        values = { o.affine,
                   static_cast<std::uint32_t>(o.tap_count),
                   static_cast<std::uint32_t>(o.normal_source),
                   o.rotate_normals,
                   o.parallel,
                   o.limit_thickness,
                   o.mark_background,
                   static_cast<std::uint32_t>(o.filter_radius),
                   depth_in_z,
                   group.x,
                   group.y };
        for (std::size_t i = 0; i < ids.size(); ++i) {
            entries[i] = { ids[i], static_cast<std::uint32_t>(i * sizeof(std::uint32_t)), sizeof(std::uint32_t) };
        }
        info = { static_cast<std::uint32_t>(entries.size()), entries.data(), sizeof(values), values.data() };
    }
    specialisation(const specialisation&) = delete;
    specialisation& operator=(const specialisation&) = delete;
};

result<owned<VkPipeline>> make_pipeline(const device& d, const plan& p, const pass& each, VkPipelineLayout layout)
{
    const std::span<const std::uint32_t> code = shader_of(d, each, p);
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = code.size_bytes();
    module_info.pCode = code.data();
    owned<VkShaderModule> module;
    AO_VK_CREATE(module, d, ShaderModule, module_info);

    const specialisation options(each.options, p.facts.depth == depth_source::position, d.host.group);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module.get();
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &options.info;
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result_code =
        d.call.CreateComputePipelines(d.host.device, d.host.pipeline_cache, 1, &info, nullptr, &pipeline);
    if (result_code != VK_SUCCESS) {
        return api_error(result_code, "vkCreateComputePipelines");
    }
    return owned<VkPipeline>(d.host.device, pipeline, d.call.DestroyPipeline);
}

std::optional<error> make_layouts(const device& d, prepared& made)
{
    constexpr std::array<VkDescriptorType, 6> types{ VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,  VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                                                     VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
                                                     VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,  VK_DESCRIPTOR_TYPE_STORAGE_IMAGE };
    std::array<VkDescriptorSetLayoutBinding, types.size()> bindings{};
    for (std::uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i] = { i, types[i], 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr };
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    AO_VK_CREATE(made.set_layout, d, DescriptorSetLayout, set);

    const VkPushConstantRange range{ VK_SHADER_STAGE_COMPUTE_BIT, 0, 128 };
    const VkDescriptorSetLayout set_layout = made.set_layout.get();
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &range;
    AO_VK_CREATE(made.layout, d, PipelineLayout, layout);
    return std::nullopt;
}

} // namespace

bool is_software(const device& d)
{
    return d.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
}

plan executed_plan(const device& d, const plan& p)
{
    if (!is_software(d) || p.facts.depth != depth_source::linear) {
        return p;
    }
    plan executed = p;
    executed.passes = {};
    pass copy;
    copy.type = pass_type::linearize;
    copy.options.affine = true;
    copy.inputs[0] = image_id::depth;
    copy.output = image_id::linear_depth;
    linearize_constants identity{};
    identity.scale = 1;
    identity.background = std::numeric_limits<float>::infinity();
    ao::detail::set_constants(copy, identity);
    executed.passes.push_back(copy);
    executed.transients.push_back({ image_id::linear_depth, pixel_format::r32f });
    for (pass each : p.passes) {
        if (each.inputs[0] == image_id::depth) {
            each.inputs[0] = image_id::linear_depth;
        }
        executed.passes.push_back(each);
    }
    return executed;
}

std::optional<error> unsupported(const device& d, const plan& p)
{
    const VkPhysicalDeviceLimits& limits = d.properties.limits;
    const auto width = static_cast<std::uint32_t>(p.facts.width);
    const auto height = static_cast<std::uint32_t>(p.facts.height);
    char text[160];
    if (width > limits.maxImageDimension2D || height > limits.maxImageDimension2D) {
        std::snprintf(text, sizeof text, "picture of %dx%d exceeds the Vulkan device's limit of %u pixels a side", p.facts.width,
                      p.facts.height, limits.maxImageDimension2D);
        return error(errc::invalid_size, text);
    }
    const group_size group = d.host.group;
    if ((width - 1) / group.x >= limits.maxComputeWorkGroupCount[0] ||
        (height - 1) / group.y >= limits.maxComputeWorkGroupCount[1]) {
        std::snprintf(text, sizeof text,
                      "picture of %dx%d takes more compute groups of %ux%u than the Vulkan device can dispatch", p.facts.width,
                      p.facts.height, group.x, group.y);
        return error(errc::invalid_size, text);
    }
    if (!can_sample(d, p.facts.depth_format)) {
        return lacks("sample", p.facts.depth_format);
    }
    if (p.facts.normals != normal_source::from_depth && !can_sample(d, p.facts.normal_format)) {
        return lacks("sample", p.facts.normal_format);
    }
    if (!can_store(d, p.facts.output_format)) {
        return lacks("store to", p.facts.output_format);
    }
    for (const transient_image& each : p.transients) {
        if (!can_sample(d, each.format)) {
            return lacks("sample", each.format);
        }
        if (!can_store(d, each.format)) {
            return lacks("store to", each.format);
        }
    }
    return std::nullopt;
}

result<program> backend::prepare(const plan& p)
{
    const device& d = *device_;
    const plan executed = executed_plan(d, p);
    if (const auto wrong = unsupported(d, executed)) {
        return *wrong;
    }
    std::unique_ptr<prepared> made(new (std::nothrow) prepared);
    if (!made) {
        return error(errc::out_of_memory, "out of memory");
    }
    made->given = p;
    made->executed = executed;
    auto own_tables = make_tables(d, executed);
    if (!own_tables) {
        return own_tables.error();
    }
    made->tables = std::move(*own_tables);
    auto pictures = make_transients(d, executed);
    if (!pictures) {
        return pictures.error();
    }
    made->transients = std::move(*pictures);
    if (const auto wrong = make_layouts(d, *made)) {
        return *wrong;
    }
    for (std::size_t i = 0; i < executed.passes.size(); ++i) {
        auto pipeline = make_pipeline(d, executed, executed.passes[i], made->layout.get());
        if (!pipeline) {
            return pipeline.error();
        }
        made->pipelines[i] = std::move(*pipeline);
    }
    return program(std::move(made));
}

} // namespace ao::vk
