#include "micro/fetch_probe.hpp"

#include "ao_bench_support_shaders.hpp"
#include "host/vulkan_timer.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace ao::bench {

namespace {

using host::failure;

class probe final : public fetch_probe {
public:
    explicit probe(host::vulkan_device& device) : device_(device) {}
    ~probe() override
    {
        vkDestroyPipeline(device_.device, pipeline_, nullptr);
        vkDestroyPipelineLayout(device_.device, layout_, nullptr);
        vkDestroyDescriptorPool(device_.device, pool_, nullptr);
        vkDestroyDescriptorSetLayout(device_.device, set_layout_, nullptr);
        vkDestroySampler(device_.device, sampler_, nullptr);
    }
    probe(const probe&) = delete;
    probe& operator=(const probe&) = delete;

    std::optional<failure> make(const picture& input, int fetches)
    {
        const host::extent size{ static_cast<unsigned>(input.width), static_cast<unsigned>(input.height) };
        auto source = host::vulkan_image::create(device_, pixel_format::r32f, size);
        auto target = host::vulkan_image::create(device_, pixel_format::r32f, size);
        auto timer = host::vulkan_timer::create(device_, 2);
        if (!source || !target || !timer) {
            return failure{ "cannot make the pictures of the fetch probe" };
        }
        source_.emplace(std::move(*source));
        target_.emplace(std::move(*target));
        timer_.emplace(std::move(*timer));
        if (!source_->upload(input.bytes) || !target_->transition(VK_IMAGE_LAYOUT_GENERAL)) {
            return failure{ "cannot fill the pictures of the fetch probe" };
        }
        return make_descriptors() && make_pipeline(fetches)
                   ? std::nullopt
                   : std::optional(failure{ "cannot make the pipeline of the fetch probe" });
    }

    host::result<double> run() override
    {
        const auto done = device_.submit([&](VkCommandBuffer commands) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
            timer_->record_reset(commands);
            timer_->record_mark(commands);
            vkCmdDispatch(commands, (target_->size.width + 7) / 8, (target_->size.height + 7) / 8, 1);
            timer_->record_mark(commands);
        });
        if (!done) {
            return failure{ done.reason() };
        }
        const auto times = timer_->read();
        if (!times) {
            return failure{ times.reason() };
        }
        return times->front();
    }

    host::result<picture> download() override
    {
        picture sums(pixel_format::r32f, static_cast<int>(target_->size.width), static_cast<int>(target_->size.height));
        if (const auto done = target_->download(sums.bytes); !done) {
            return failure{ done.reason() };
        }
        return sums;
    }

private:
    bool make_descriptors()
    {
        VkSamplerCreateInfo sampler{};
        sampler.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
        sampler.maxLod = VK_LOD_CLAMP_NONE;
        const std::array<VkDescriptorSetLayoutBinding, 2> bindings{
            { { 0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr },
              { 1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr } }
        };
        VkDescriptorSetLayoutCreateInfo set_layout{};
        set_layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        set_layout.bindingCount = static_cast<std::uint32_t>(bindings.size());
        set_layout.pBindings = bindings.data();
        const std::array<VkDescriptorPoolSize, 2> sizes{ { { VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1 },
                                                           { VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1 } } };
        VkDescriptorPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
        pool.maxSets = 1;
        pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
        pool.pPoolSizes = sizes.data();
        const VkDevice device = device_.device;
        if (vkCreateSampler(device, &sampler, nullptr, &sampler_) != VK_SUCCESS ||
            vkCreateDescriptorSetLayout(device, &set_layout, nullptr, &set_layout_) != VK_SUCCESS ||
            vkCreateDescriptorPool(device, &pool, nullptr, &pool_) != VK_SUCCESS) {
            return false;
        }
        VkDescriptorSetAllocateInfo allocate{};
        allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
        allocate.descriptorPool = pool_;
        allocate.descriptorSetCount = 1;
        allocate.pSetLayouts = &set_layout_;
        if (vkAllocateDescriptorSets(device, &allocate, &set_) != VK_SUCCESS) {
            return false;
        }
        const VkDescriptorImageInfo from{ sampler_, source_->view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL };
        const VkDescriptorImageInfo to{ VK_NULL_HANDLE, target_->view, VK_IMAGE_LAYOUT_GENERAL };
        std::array<VkWriteDescriptorSet, 2> writes{};
        for (std::uint32_t i = 0; i < writes.size(); ++i) {
            writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
            writes[i].dstSet = set_;
            writes[i].dstBinding = i;
            writes[i].descriptorCount = 1;
            writes[i].descriptorType = bindings[i].descriptorType;
            writes[i].pImageInfo = i == 0 ? &from : &to;
        }
        vkUpdateDescriptorSets(device, static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
        return true;
    }

    bool make_pipeline(int fetches)
    {
        const VkDevice device = device_.device;
        VkPipelineLayoutCreateInfo layout{};
        layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
        layout.setLayoutCount = 1;
        layout.pSetLayouts = &set_layout_;
        VkShaderModuleCreateInfo code{};
        code.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        code.codeSize = shaders::fetch_comp.size_bytes();
        code.pCode = shaders::fetch_comp.data();
        VkShaderModule module = VK_NULL_HANDLE;
        if (vkCreatePipelineLayout(device, &layout, nullptr, &layout_) != VK_SUCCESS ||
            vkCreateShaderModule(device, &code, nullptr, &module) != VK_SUCCESS) {
            return false;
        }
        const VkSpecializationMapEntry entry{ 0, 0, sizeof fetches };
        const VkSpecializationInfo constants{ 1, &entry, sizeof fetches, &fetches };
        VkComputePipelineCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
        info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        info.stage.module = module;
        info.stage.pName = "main";
        info.stage.pSpecializationInfo = &constants;
        info.layout = layout_;
        const bool made = vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_) == VK_SUCCESS;
        vkDestroyShaderModule(device, module, nullptr);
        return made;
    }

    host::vulkan_device& device_;
    std::optional<host::vulkan_image> source_;
    std::optional<host::vulkan_image> target_;
    std::optional<host::vulkan_timer> timer_;
    VkSampler sampler_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

} // namespace

host::result<std::unique_ptr<fetch_probe>> fetch_probe::create(host::vulkan_device& device, const picture& r32f, int fetches)
{
    auto made = std::make_unique<probe>(device);
    if (const auto wrong = made->make(r32f, fetches)) {
        return *wrong;
    }
    return std::unique_ptr<fetch_probe>(std::move(made));
}

picture expected_sums(const picture& r32f, int fetches)
{
    picture sums(pixel_format::r32f, r32f.width, r32f.height);
    for (int y = 0; y < r32f.height; ++y) {
        for (int x = 0; x < r32f.width; ++x) {
            std::uint32_t state = static_cast<std::uint32_t>(x) * 747796405U + static_cast<std::uint32_t>(y) * 2891336453U;
            float sum = 0;
            for (int i = 0; i < fetches; ++i) {
                state = state * 747796405U + 2891336453U;
                const int u = std::clamp(x + static_cast<int>(state >> 26U) - 32, 0, r32f.width - 1);
                const int v = std::clamp(y + static_cast<int>(state >> 20U & 63U) - 32, 0, r32f.height - 1);
                sum += r32f.texel<float>(static_cast<std::size_t>(v * r32f.width + u));
            }
            sums.set_texel(static_cast<std::size_t>(y * r32f.width + x), sum);
        }
    }
    return sums;
}

} // namespace ao::bench
