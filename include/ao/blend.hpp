// How a tree of blended materials is evaluated (paper 4): constant weights pruned, the larger child first (Sethi and Ullman, JACM
// 17(4), 1970), so that a tree of n leaves needs no more than floor(log2 n) + 1 results at a time and a chain 2. Shared
// subtrees are evaluated once. Nothing here recurses: depth is bounded by memory only.
#pragma once

#include "ao/math.hpp"
#include "ao/result.hpp"
#include "ao/scene_check.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ao {

// I = (1 - b) first + b second; b = 0 and b = 1 return the child's bits. Precondition: b in [0, 1].
template <class Real>
constexpr glm::vec<3, Real> blend(const glm::vec<3, Real>& first, const glm::vec<3, Real>& second, Real b)
{
    return math<Real>::ao_blend(first, second, b);
}

// What a weight counts as: outside [0, 1] the nearer end, 0 for NaN.
template <class Real>
constexpr Real clamp_mask(Real b)
{
    return math<Real>::ao_clamp_mask(b);
}

inline constexpr int most_registers = 16; // of one pass: enough for any tree of less than 2^16 leaves

struct blend_settings {
    // Results that one pass may hold at a time, 1 to 16. Trees that need more are cut: subtrees that fit in passes of their
    // own, each into a picture, and a pass per blend above. 1 is the paper's form: every leaf into a picture.
    int registers = 16;
    bool fixed_k = true; // false where k is to change at run time: then k of 0 and 1 prune nothing, masks still do
};

enum class blend_operation { leaf, mix, fetch };

struct blend_instruction {
    blend_operation operation{};
    int target = 0; // register
    int first = 0;  // mix: registers
    int second = 0;
    int source = 0; // leaf: material; mix: blend node; fetch: picture of an earlier segment

    friend constexpr bool operator==(const blend_instruction&, const blend_instruction&) = default;
};

inline constexpr int blend_result = -1;

// One pass: instructions whose last result goes to a picture, or is the program's own (blend_result).
struct blend_segment {
    std::size_t first = 0;
    std::size_t count = 0;
    int output = blend_result;
};

struct blend_program {
    int root = 0; // node of scene::blends
    std::vector<blend_instruction> instructions;
    std::vector<blend_segment> segments; // one: the whole program in one pass
    int registers = 0;                   // results held at a time, at most, within a segment
    int pictures = 0;                    // between segments
    int leaves = 0;                      // evaluated
    int mixes = 0;                       // nodes evaluated, each once
    int label = 0;                       // results held at a time by the paper's form: the Sethi-Ullman number of a tree

    constexpr bool fused() const { return segments.size() == 1; }
    constexpr int passes() const { return static_cast<int>(segments.size()); }
    constexpr int paper_passes() const { return leaves + mixes; }
};

// Plans the blends of one scene. Linear in the nodes once, then in the nodes that a root reaches.
class blend_planner {
public:
    // Fails where a child or mask does not exist, k is no number in [0, 1], or nodes form a cycle.
    static constexpr result<blend_planner> create(const scene& s, const blend_settings& settings = {})
    {
        if (settings.registers < 1 || settings.registers > most_registers) {
            return error(errc::invalid_settings, "registers of a blend pass must be 1 to 16");
        }
        if (const auto wrong = detail::check_blend_nodes(s.blends, s.materials.size(), s.textures.size())) {
            return *wrong;
        }
        const result<std::vector<std::uint32_t>> order = detail::blend_order(s.blends);
        if (!order) {
            return order.error();
        }
        return blend_planner(s, settings, *order);
    }

    // Precondition: root is a node of the scene.
    constexpr blend_program program(int root)
    {
        blend_program p;
        p.root = root;
        const int start = resolved_[static_cast<std::size_t>(root)];
        reach(start);
        forget();
        const sequence whole = sequence_of(start, false);
        p.label = whole.peak;
        for (const step& each : whole.steps) {
            ++(each.node >= 0 ? p.leaves : p.mixes);
        }
        if (whole.peak <= settings_.registers) {
            append(p, whole, blend_result);
            return p;
        }
        cut(p, start);
        return p;
    }

    // What a node or material comes to after pruning.
    constexpr int resolved(int child) const { return child >= 0 ? child : resolved_[detail::blend_index(child)]; }
    // Sethi-Ullman number of a node, counting shared subtrees as often as they occur.
    constexpr int label(int child) const { return child >= 0 ? 1 : labels_[detail::blend_index(child)]; }

private:
    // A leaf (node >= 0), a unit evaluated elsewhere, or a blend of two registers.
    struct step {
        int node = 0;
        int target = 0;
        int first = 0;
        int second = 0;
    };
    struct sequence {
        std::vector<step> steps;
        int peak = 0;
    };

    constexpr blend_planner(const scene& s, const blend_settings& settings, const std::vector<std::uint32_t>& order)
        : settings_(settings),
          nodes_(s.blends.begin(), s.blends.end())
    {
        const std::size_t count = nodes_.size();
        resolved_.resize(count, 0);
        labels_.resize(count, 0);
        uses_.resize(count, 0);
        left_.resize(count, 0);
        registers_.resize(count, 0);
        whole_.resize(count, 0);
        sizes_.resize(count, 0);
        detail::constant_weights constant(s, settings.fixed_k);
        for (const std::uint32_t node : order) {
            blend_node& blend = nodes_[node];
            blend.first = resolved(blend.first);
            blend.second = resolved(blend.second);
            const std::optional<int> weight = constant.of(blend);
            if (weight) {
                resolved_[node] = *weight == 0 ? blend.first : blend.second;
                labels_[node] = label(resolved_[node]);
                continue;
            }
            resolved_[node] = -1 - static_cast<int>(node);
            labels_[node] = joined(label(blend.first), label(blend.second));
        }
    }

    static constexpr int joined(int a, int b) { return a == b ? a + 1 : a > b ? a : b; }
    constexpr const blend_node& node_of(int child) const { return nodes_[detail::blend_index(child)]; }

    // Finds the nodes under `root`, how often each is used, and which are trees by themselves.
    constexpr void reach(int root)
    {
        for (const int node : reached_) {
            uses_[detail::blend_index(node)] = 0;
        }
        reached_.clear();
        if (root >= 0) {
            return;
        }
        std::vector<int> stack{ root };
        uses_[detail::blend_index(root)] = 1;
        while (!stack.empty()) {
            const int node = stack.back();
            stack.pop_back();
            reached_.push_back(node);
            for (const int child : { node_of(node).first, node_of(node).second }) {
                if (child < 0 && uses_[detail::blend_index(child)]++ == 0) {
                    stack.push_back(child);
                }
            }
        }
        for (const int node : upward()) {
            char& whole = whole_[detail::blend_index(node)];
            whole = 1;
            for (const int child : { node_of(node).first, node_of(node).second }) {
                if (child < 0 && (uses_[detail::blend_index(child)] > 1 || whole_[detail::blend_index(child)] == 0)) {
                    whole = 0;
                }
            }
        }
    }

    // The reached nodes, children before parents.
    constexpr std::vector<int> upward()
    {
        forget();
        std::vector<int> order;
        std::vector<int> ready;
        if (!reached_.empty()) {
            ready.push_back(reached_.front());
        }
        while (!ready.empty()) {
            const int node = ready.back();
            ready.pop_back();
            order.push_back(node);
            for (const int child : { node_of(node).first, node_of(node).second }) {
                if (child < 0 && --left_[detail::blend_index(child)] == 0) {
                    ready.push_back(child);
                }
            }
        }
        std::reverse(order.begin(), order.end());
        return order;
    }

    // As if nothing were evaluated yet.
    constexpr void forget()
    {
        for (const int node : reached_) {
            left_[detail::blend_index(node)] = uses_[detail::blend_index(node)];
            registers_[detail::blend_index(node)] = none;
        }
    }

    // Trees that one pass has room for.
    constexpr bool is_unit(int node) const
    {
        return whole_[detail::blend_index(node)] != 0 && label(node) <= settings_.registers;
    }
    // Results needed where units count as one.
    constexpr int size(int child) const { return child >= 0 ? 1 : sizes_[detail::blend_index(child)]; }

    // Evaluates `root` with the larger child first. `cut`: units are one step. Precondition: no node under `root` has been
    // evaluated since forget().
    constexpr sequence sequence_of(int root, bool cut)
    {
        const auto needed = [&](int child) { return cut ? size(child) : label(child); };
        struct frame {
            int node;
            int phase;      // children evaluated
            bool swapped;   // the second child goes first
            int results[2]; // registers of the children
        };
        sequence made;
        std::vector<char> taken;
        int held = 0;
        const auto take = [&] {
            const auto free = std::find(taken.begin(), taken.end(), char{ 0 });
            const auto slot = static_cast<std::size_t>(free - taken.begin());
            if (slot == taken.size()) {
                taken.push_back(0);
            }
            taken[slot] = 1;
            made.peak = ++held > made.peak ? held : made.peak;
            return static_cast<int>(slot);
        };
        const auto release = [&](int child, int slot) {
            if (child < 0 && --left_[detail::blend_index(child)] > 0) {
                return;
            }
            taken[static_cast<std::size_t>(slot)] = 0;
            --held;
        };
        std::vector<frame> stack{ { root, 0, false, {} } };
        while (!stack.empty()) {
            frame& top = stack.back();
            int slot = none;
            if (top.node < 0) {
                slot = registers_[detail::blend_index(top.node)];
            }
            if (slot == none && (top.node >= 0 || (cut && is_unit(top.node)))) {
                slot = take();
                made.steps.push_back({ top.node, slot, none, none });
            }
            else if (slot == none && top.phase < 2) {
                const blend_node& blend = node_of(top.node);
                if (top.phase == 0) {
                    top.swapped = needed(blend.second) > needed(blend.first);
                }
                const bool second = (top.phase == 1) != top.swapped;
                stack.push_back({ second ? blend.second : blend.first, 0, false, {} });
                continue;
            }
            else if (slot == none) {
                const blend_node& blend = node_of(top.node);
                const int first = top.results[top.swapped ? 1 : 0];
                const int second = top.results[top.swapped ? 0 : 1];
                release(blend.first, first);
                release(blend.second, second);
                slot = take();
                made.steps.push_back({ top.node, slot, first, second });
            }
            if (top.node < 0) {
                registers_[detail::blend_index(top.node)] = slot;
            }
            stack.pop_back();
            if (!stack.empty()) {
                frame& parent = stack.back();
                parent.results[parent.phase++] = slot;
            }
        }
        return made;
    }

    // Appends a sequence without units as one segment.
    static constexpr void append(blend_program& p, const sequence& s, int output)
    {
        const std::size_t first = p.instructions.size();
        for (const step& each : s.steps) {
            if (each.node >= 0) {
                p.instructions.push_back({ blend_operation::leaf, each.target, 0, 0, each.node });
            }
            else {
                p.instructions.push_back({ blend_operation::mix, each.target, each.first, each.second,
                                           static_cast<int>(detail::blend_index(each.node)) });
            }
        }
        p.segments.push_back({ first, s.steps.size(), output });
        p.registers = s.peak > p.registers ? s.peak : p.registers;
    }

    // Units that fit one pass, each into a picture, and a pass per blend above them.
    constexpr void cut(blend_program& p, int root)
    {
        for (const int node : upward()) {
            const blend_node& blend = node_of(node);
            sizes_[detail::blend_index(node)] = is_unit(node) ? 1 : joined(size(blend.first), size(blend.second));
        }
        forget();
        const sequence above = sequence_of(root, true);
        forget();
        p.pictures = above.peak;
        for (const step& each : above.steps) {
            const int output = &each == &above.steps.back() ? blend_result : each.target;
            if (each.first == none) {
                append(p, sequence_of(each.node, false), output);
                continue;
            }
            const std::size_t first = p.instructions.size();
            p.instructions.push_back({ blend_operation::fetch, 0, 0, 0, each.first });
            p.instructions.push_back({ blend_operation::fetch, 1, 0, 0, each.second });
            p.instructions.push_back({ blend_operation::mix, 0, 0, 1, static_cast<int>(detail::blend_index(each.node)) });
            p.segments.push_back({ first, 3, output });
            p.registers = p.registers < 2 ? 2 : p.registers;
        }
    }

    static constexpr int none = -1;

    blend_settings settings_;
    std::vector<blend_node> nodes_; // children pruned
    std::vector<int> resolved_;
    std::vector<int> labels_;
    // Of the nodes reached last:
    std::vector<int> reached_;
    std::vector<int> uses_;
    std::vector<int> left_;
    std::vector<int> registers_;
    std::vector<char> whole_;
    std::vector<int> sizes_;
};

} // namespace ao
