#pragma once

#include "ao/result.hpp"
#include "host/vulkan_device.hpp"

#include <glm/vec4.hpp>

#include <span>

namespace ao::host {

// The shared functions as this driver compiles them, in a compute shader.
ao::result<success> evaluate_vk(vulkan_device& device, int function, std::span<const glm::vec4> a, std::span<const glm::vec4> b,
                                std::span<glm::vec4> out);

} // namespace ao::host
