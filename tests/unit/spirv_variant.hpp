// What is left of a SPIR-V module once its specialisation constants are known, as a driver's compiler would see it.
#pragma once

#include <spirv-tools/optimizer.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace spirv_test {

using words = std::vector<std::uint32_t>;

// By constant id; others keep their defaults.
inline words specialised(std::span<const std::uint32_t> module, const std::map<std::uint32_t, std::uint32_t>& constants)
{
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
    for (const auto& [id, value] : constants) {
        values[id] = { value };
    }
    spvtools::Optimizer optimizer(SPV_ENV_UNIVERSAL_1_3);
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values));
    optimizer.RegisterPass(spvtools::CreateFreezeSpecConstantValuePass());
    optimizer.RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
    optimizer.RegisterPerformancePasses();
    optimizer.RegisterPass(spvtools::CreateRemoveUnusedInterfaceVariablesPass());
    words result;
    if (!optimizer.Run(module.data(), module.size(), &result)) {
        throw std::runtime_error("spirv-tools refuse the module");
    }
    return result;
}

class module_view {
public:
    explicit module_view(const words& module)
    {
        if (module.size() < 5 || module[0] != 0x07230203U) {
            throw std::runtime_error("not a SPIR-V module");
        }
        bool in_function = false;
        for (std::size_t at = 5; at < module.size(); at += module[at] >> 16U) {
            const std::uint32_t opcode = module[at] & 0xffffU;
            const auto length = static_cast<std::size_t>(module[at] >> 16U);
            if (length == 0 || at + length > module.size()) {
                throw std::runtime_error("a SPIR-V module cut short");
            }
            const std::span<const std::uint32_t> operands(module.data() + at + 1, length - 1);
            in_function = in_function || opcode == op_function;
            if (in_function) {
                ++instructions_;
                opcodes_.insert(opcode);
            }
            else {
                read(opcode, operands);
            }
        }
    }

    std::size_t instructions() const { return instructions_; } // of functions
    bool has(std::uint32_t opcode) const { return opcodes_.count(opcode) != 0; }

    // Buffers, pictures and samplers that are still declared, by the variable's or else its block's name without the prefix.
    std::set<std::string> resources() const { return variables({ 0, 2, 9, 12 }); }
    std::set<std::string> inputs() const { return variables({ 1 }); }

    static constexpr std::uint32_t op_kill = 252;

private:
    struct variable {
        std::uint32_t id;
        std::uint32_t type; // of the pointer
        std::uint32_t storage;
    };
    static constexpr std::uint32_t op_name = 5;
    static constexpr std::uint32_t op_type_pointer = 32;
    static constexpr std::uint32_t op_function = 54;
    static constexpr std::uint32_t op_variable = 59;

    void read(std::uint32_t opcode, std::span<const std::uint32_t> operands)
    {
        if (opcode == op_name) {
            std::string text;
            for (std::size_t i = 4; i < 4 * operands.size(); ++i) {
                const auto letter = static_cast<char>(operands[i / 4] >> (8 * (i % 4)) & 255U);
                if (letter == '\0') {
                    break;
                }
                text += letter;
            }
            names_[operands[0]] = text.starts_with("ao_") ? text.substr(3) : text;
        }
        else if (opcode == op_type_pointer) {
            pointees_[operands[0]] = operands[2];
        }
        else if (opcode == op_variable) {
            variables_.push_back({ operands[1], operands[0], operands[2] });
        }
    }
    std::set<std::string> variables(const std::set<std::uint32_t>& storage) const
    {
        std::set<std::string> found;
        for (const variable& v : variables_) {
            if (storage.count(v.storage) != 0) {
                const auto name = names_.find(v.id);
                found.insert(name != names_.end() && !name->second.empty() ? name->second : names_.at(pointees_.at(v.type)));
            }
        }
        return found;
    }

    std::size_t instructions_ = 0;
    std::set<std::uint32_t> opcodes_;
    std::map<std::uint32_t, std::string> names_;
    std::map<std::uint32_t, std::uint32_t> pointees_;
    std::vector<variable> variables_;
};

} // namespace spirv_test
