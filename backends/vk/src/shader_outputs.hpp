// Fragment shaders cut to the attachments that there are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ao::vk {

// The shader without those outputs whose location's bit in `kept` is 0, and the others' locations counted from 0 without gaps.
// A specialisation constant alone leaves outputs that nothing consumes, and takes as many attachments as there are locations.
// Precondition: valid SPIR-V that only stores to its outputs, each as a whole.
std::vector<std::uint32_t> with_outputs(std::span<const std::uint32_t> code, std::uint32_t kept);

} // namespace ao::vk
