#include "host/spirv_check.hpp"

#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace ao::host {
namespace {
// Numbers from the SPIR-V 1.6 specification, 3.42, and from GLSL.std.450.
enum opcode : unsigned {
    op_name = 5,
    op_ext_inst_import = 11,
    op_ext_inst = 12,
    op_function = 54,
    op_function_end = 56,
    op_decorate = 71,
    op_dpdx = 207,
    op_fwidth_coarse = 215,
};
constexpr std::uint32_t no_contraction = 42;

constexpr std::pair<unsigned, const char*> contractible[] = {
    { 129, "OpFAdd" }, { 131, "OpFSub" }, { 133, "OpFMul" }, { 136, "OpFDiv" }, { 142, "OpVectorTimesScalar" },
};
constexpr std::pair<unsigned, const char*> forbidden[] = {
    { 140, "OpFRem" },
    { 141, "OpFMod" },
    { 143, "OpMatrixTimesScalar" },
    { 144, "OpVectorTimesMatrix" },
    { 145, "OpMatrixTimesVector" },
    { 146, "OpMatrixTimesMatrix" },
    { 147, "OpOuterProduct" },
    { 148, "OpDot" },
};
// Everything else of GLSL.std.450 has a tolerance or an open order of evaluation. Sqrt is correctly rounded on the
// software drivers and inside the bounds of math<interval> on hardware.
constexpr std::pair<unsigned, const char*> exact_ext[] = {
    { 2, "RoundEven" }, { 3, "Trunc" },     { 4, "FAbs" },    { 5, "SAbs" },  { 6, "FSign" },
    { 7, "SSign" },     { 8, "Floor" },     { 9, "Ceil" },    { 31, "Sqrt" }, { 37, "FMin" },
    { 38, "UMin" },     { 39, "SMin" },     { 40, "FMax" },   { 41, "UMax" }, { 42, "SMax" },
    { 43, "FClamp" },   { 44, "UClamp" },   { 45, "SClamp" }, { 48, "Step" }, { 73, "FindILsb" },
    { 74, "FindSMsb" }, { 75, "FindUMsb" }, { 79, "NMin" },   { 80, "NMax" }, { 81, "NClamp" },
};
constexpr std::pair<unsigned, const char*> inexact_ext[] = {
    { 1, "Round" },       { 10, "Fract" },       { 11, "Radians" },     { 12, "Degrees" },       { 13, "Sin" },
    { 14, "Cos" },        { 15, "Tan" },         { 16, "Asin" },        { 17, "Acos" },          { 18, "Atan" },
    { 25, "Atan2" },      { 26, "Pow" },         { 27, "Exp" },         { 28, "Log" },           { 29, "Exp2" },
    { 30, "Log2" },       { 32, "InverseSqrt" }, { 33, "Determinant" }, { 34, "MatrixInverse" }, { 46, "FMix" },
    { 49, "SmoothStep" }, { 50, "Fma" },         { 66, "Length" },      { 67, "Distance" },      { 68, "Cross" },
    { 69, "Normalize" },  { 70, "FaceForward" }, { 71, "Reflect" },     { 72, "Refract" },
};

template <std::size_t N>
const char* find(const std::pair<unsigned, const char*> (&table)[N], unsigned number)
{
    for (const auto& [key, name] : table)
        if (key == number)
            return name;
    return nullptr;
}

std::string literal_string(std::span<const std::uint32_t> words)
{
    std::string out;
    for (const std::uint32_t word : words)
        for (unsigned shift = 0; shift < 32; shift += 8) {
            const char c = static_cast<char>((word >> shift) & 0xffu);
            if (c == '\0')
                return out;
            out.push_back(c);
        }
    return out;
}

struct reader {
    std::unordered_map<std::uint32_t, std::string> names;
    std::unordered_set<std::uint32_t> uncontracted;
    std::unordered_set<std::uint32_t> glsl_imports;
    std::string function;
    std::vector<std::string> faults;

    void fault(const std::string& what) { faults.push_back(function + ": " + what); }

    void arithmetic(unsigned op, std::span<const std::uint32_t> i)
    {
        if (const char* name = find(contractible, op); name && i.size() > 2 && !uncontracted.contains(i[2]))
            fault(std::string(name) + " without NoContraction");
        if (const char* name = find(forbidden, op))
            fault(std::string(name) + " leaves its order of evaluation open");
        if (op >= op_dpdx && op <= op_fwidth_coarse)
            fault("a derivative, which is an estimate");
        if (op == op_ext_inst && i.size() > 4 && !(glsl_imports.contains(i[3]) && find(exact_ext, i[4]))) {
            const char* name = glsl_imports.contains(i[3]) ? find(inexact_ext, i[4]) : nullptr;
            fault("OpExtInst " + (name ? std::string(name) : std::to_string(i[4])) + " is not exactly defined");
        }
    }

    void instruction(unsigned op, std::span<const std::uint32_t> i)
    {
        if (op == op_name && i.size() > 2)
            names[i[1]] = literal_string(i.subspan(2));
        else if (op == op_decorate && i.size() > 2 && i[2] == no_contraction)
            uncontracted.insert(i[1]);
        else if (op == op_ext_inst_import && i.size() > 2 && literal_string(i.subspan(2)) == "GLSL.std.450")
            glsl_imports.insert(i[1]);
        else if (op == op_function && i.size() > 2) {
            const std::string& mangled = names[i[2]];
            if (mangled.empty())
                faults.emplace_back("a function without a name: compiled without OpName?");
            function = mangled.substr(0, mangled.find('('));
        }
        else if (op == op_function_end)
            function.clear();
        else if (function.starts_with("ao_"))
            arithmetic(op, i);
    }
};
}

std::vector<std::string> inexact_operations(std::span<const std::uint32_t> module)
{
    if (module.size() < 5 || module[0] != 0x07230203u)
        return { "not a SPIR-V module" };
    reader state;
    for (std::size_t at = 5; at < module.size();) {
        const std::size_t length = module[at] >> 16;
        if (length == 0 || length > module.size() - at)
            return { "a truncated SPIR-V module" };
        state.instruction(module[at] & 0xffffu, module.subspan(at, length));
        at += length;
    }
    if (!state.function.empty())
        return { "a truncated SPIR-V module" };
    return state.faults;
}
}
