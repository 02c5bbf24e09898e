#include "host/spirv_check.hpp"
#include "test_host_shaders.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using ao::host::inexact_operations;

static bool mentions(const std::vector<std::string>& faults, const std::string& text)
{
    return std::any_of(faults.begin(), faults.end(),
                       [&](const std::string& fault) { return fault.find(text) != std::string::npos; });
}

TEST_CASE("an exact shader has no fault")
{
    CHECK(inexact_operations(planted::exact_comp).empty());
}

TEST_CASE("every planted inexact operation is named with its function")
{
    for (const auto module : { planted::inexact_comp, planted::inexact_comp_vulkan }) {
        const auto faults = inexact_operations(module);
        CHECK(mentions(faults, "ao_contracted: OpFMul without NoContraction"));
        CHECK(mentions(faults, "ao_contracted: OpFAdd without NoContraction"));
        CHECK(mentions(faults, "ao_unordered: OpDot"));
        CHECK(mentions(faults, "ao_unordered: OpExtInst Normalize"));
        CHECK(mentions(faults, "ao_tolerant: OpExtInst Sin"));
        CHECK(mentions(faults, "ao_tolerant: OpExtInst FMix"));
        CHECK(mentions(faults, "ao_transformed: OpMatrixTimesVector"));
        CHECK_FALSE(mentions(faults, "free_to_contract"));
        CHECK_FALSE(mentions(faults, "main"));
    }
}

TEST_CASE("what is no SPIR-V, or truncated, or without names is a fault")
{
    CHECK_FALSE(inexact_operations({}).empty());
    const std::uint32_t other[8] = { 1, 2, 3 };
    CHECK_FALSE(inexact_operations(other).empty());
    CHECK_FALSE(inexact_operations(planted::exact_comp.first(planted::exact_comp.size() - 1)).empty());

    std::vector<std::uint32_t> stripped(planted::exact_comp.begin(), planted::exact_comp.begin() + 5);
    for (std::size_t at = 5; at < planted::exact_comp.size(); at += planted::exact_comp[at] >> 16)
        if ((planted::exact_comp[at] & 0xffffu) != 5)
            stripped.insert(stripped.end(), planted::exact_comp.begin() + static_cast<std::ptrdiff_t>(at),
                            planted::exact_comp.begin() + static_cast<std::ptrdiff_t>(at + (planted::exact_comp[at] >> 16)));
    CHECK(mentions(inexact_operations(stripped), "without a name"));
}
