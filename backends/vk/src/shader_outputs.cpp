#include "shader_outputs.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace ao::vk {

namespace {

// Of the SPIR-V specification, 3.32 and 3.7, 3.20.
enum : std::uint32_t {
    op_name = 5,
    op_entry_point = 15,
    op_variable = 59,
    op_store = 62,
    op_decorate = 71,
    storage_output = 3,
    decoration_location = 30,
    header_words = 5
};

// f(opcode, words) for every instruction; words[0] is the opcode's.
template <class Function>
void for_each_instruction(std::span<const std::uint32_t> code, Function f)
{
    for (std::size_t at = header_words; at < code.size();) {
        const std::size_t count = code[at] >> 16U;
        f(code[at] & 0xffffU, code.subspan(at, count));
        at += count;
    }
}

bool decorates_location(std::uint32_t opcode, std::span<const std::uint32_t> words)
{
    return opcode == op_decorate && words[2] == decoration_location;
}

// Output variables at locations that are not kept.
std::vector<std::uint32_t> unwanted(std::span<const std::uint32_t> code, std::uint32_t kept)
{
    std::vector<std::uint32_t> elsewhere;
    std::vector<std::uint32_t> found;
    for_each_instruction(code, [&](std::uint32_t opcode, std::span<const std::uint32_t> words) {
        if (decorates_location(opcode, words) && (kept >> words[3] & 1U) == 0) {
            elsewhere.push_back(words[1]);
        }
        else if (opcode == op_variable && words[3] == storage_output &&
                 std::find(elsewhere.begin(), elsewhere.end(), words[2]) != elsewhere.end()) {
            found.push_back(words[2]);
        }
    });
    return found;
}

std::vector<std::uint32_t> outputs(std::span<const std::uint32_t> code)
{
    std::vector<std::uint32_t> found;
    for_each_instruction(code, [&](std::uint32_t opcode, std::span<const std::uint32_t> words) {
        if (opcode == op_variable && words[3] == storage_output) {
            found.push_back(words[2]);
        }
    });
    return found;
}

} // namespace

std::vector<std::uint32_t> with_outputs(std::span<const std::uint32_t> code, std::uint32_t kept)
{
    const std::vector<std::uint32_t> gone = unwanted(code, kept);
    const std::vector<std::uint32_t> all = outputs(code);
    const auto in = [](const std::vector<std::uint32_t>& ids, std::uint32_t id) {
        return std::find(ids.begin(), ids.end(), id) != ids.end();
    };
    std::vector<std::uint32_t> cut(code.begin(), code.begin() + header_words);
    cut.reserve(code.size());
    for_each_instruction(code, [&](std::uint32_t opcode, std::span<const std::uint32_t> words) {
        const std::size_t start = cut.size();
        if (opcode == op_entry_point) {
            // The name ends with the word whose last byte is 0; the interface follows.
            std::size_t name_end = 3;
            while ((words[name_end] & 0xff000000U) != 0) {
                ++name_end;
            }
            cut.insert(cut.end(), words.begin(), words.begin() + static_cast<std::ptrdiff_t>(name_end + 1));
            for (const std::uint32_t id : words.subspan(name_end + 1)) {
                if (!in(gone, id)) {
                    cut.push_back(id);
                }
            }
            cut[start] = static_cast<std::uint32_t>(cut.size() - start) << 16U | opcode;
            return;
        }
        const bool of_variable = opcode == op_name || opcode == op_decorate || opcode == op_store;
        if ((of_variable && in(gone, words[1])) || (opcode == op_variable && in(gone, words[2]))) {
            return;
        }
        cut.insert(cut.end(), words.begin(), words.end());
        if (decorates_location(opcode, words) && in(all, words[1])) {
            cut.back() = static_cast<std::uint32_t>(std::popcount(kept & ((1U << words[3]) - 1)));
        }
    });
    return cut;
}

} // namespace ao::vk
