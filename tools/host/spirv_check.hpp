#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ao::host {
// What keeps a SPIR-V module from giving the same bits everywhere. Inside every function whose name starts with
// `ao_`: a floating-point + - * / or vector times scalar without NoContraction, and every operation whose order or
// precision is left open (dot, matrix products, all extended instructions but the exactly defined ones).
// One line per fault, "function: instruction". A module without names is a fault itself, so is a malformed one.
std::vector<std::string> inexact_operations(std::span<const std::uint32_t> module);
}
