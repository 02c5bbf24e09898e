#include "pipeline.hpp"

#include <cassert>

namespace ao::vk {

specialisation::specialisation(std::span<const specialisation_value> values)
{
    assert(values.size() <= most);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values_[i] = values[i].value;
        entries_[i] = { values[i].id, static_cast<std::uint32_t>(i * sizeof(std::uint32_t)), sizeof(std::uint32_t) };
    }
    info_ = { static_cast<std::uint32_t>(values.size()), entries_.data(), values.size() * sizeof(std::uint32_t), values_.data() };
}

result<owned<VkShaderModule>> make_module(const device& d, std::span<const std::uint32_t> code)
{
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    return create<VkShaderModule>(d, d.call.CreateShaderModule, d.call.DestroyShaderModule, info, "vkCreateShaderModule");
}

result<owned<VkPipeline>> make_compute_pipeline(const device& d, std::span<const std::uint32_t> code,
                                                std::span<const specialisation_value> values, VkPipelineLayout layout)
{
    auto module = make_module(d, code);
    if (!module) {
        return module.error();
    }
    const specialisation constants(values);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module->get();
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = constants.info();
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult code_of = d.call.CreateComputePipelines(d.host.device, d.host.pipeline_cache, 1, &info, nullptr, &pipeline);
    if (code_of != VK_SUCCESS) {
        return api_error(code_of, "vkCreateComputePipelines");
    }
    return owned<VkPipeline>(d.host.device, pipeline, d.call.DestroyPipeline);
}

} // namespace ao::vk
