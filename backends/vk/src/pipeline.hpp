// Shader modules, their constants and pipelines of compute shaders.
#pragma once

#include "device.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace ao::vk {

// A specialisation constant by its id; bools are 0 or 1.
struct specialisation_value {
    std::uint32_t id;
    std::uint32_t value;
};

// What VkSpecializationInfo points to; stays where it is.
class specialisation {
public:
    explicit specialisation(std::span<const specialisation_value> values);
    specialisation(const specialisation&) = delete;
    specialisation& operator=(const specialisation&) = delete;
    const VkSpecializationInfo* info() const { return &info_; }

private:
    static constexpr std::size_t most = 16;
    std::array<std::uint32_t, most> values_{};
    std::array<VkSpecializationMapEntry, most> entries_{};
    VkSpecializationInfo info_{};
};

result<owned<VkShaderModule>> make_module(const device& d, std::span<const std::uint32_t> code);

result<owned<VkPipeline>> make_compute_pipeline(const device& d, std::span<const std::uint32_t> code,
                                                std::span<const specialisation_value> values, VkPipelineLayout layout);

} // namespace ao::vk
