#include "blend_file.hpp"

#include "error.hpp"
#include "json_file.hpp"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

namespace ao::tools {
namespace {

// Where a name leads: what ao::object::material holds, and how many there are of that name.
struct named {
    int material = 0;
    int count = 0;
};

class reader {
public:
    reader(const json_file& file, std::string directory, const model_names& model, const mask_loader& load_mask)
        : file_(file),
          directory_(std::move(directory)),
          model_(model),
          load_mask_(load_mask)
    {
        for (std::size_t i = 0; i < model.materials.size(); ++i) {
            named& entry = names_[model.materials[i]];
            entry.material = static_cast<int>(i);
            ++entry.count;
        }
    }

    blend_file read()
    {
        const json_value root = file_.root();
        root.allow({ "blends", "use" });
        if (const auto blends = root.find("blends")) {
            if (!blends->is_object())
                blends->fail("must be an object of blends by name");
            for (const json_value& blend : blends->children())
                define(blend);
        }
        if (const auto use = root.find("use")) {
            use->allow({ "objects", "materials" });
            result_.of_object = choices(use->find("objects"), model_.objects, "object");
            result_.of_material = choices(use->find("materials"), model_.materials, "material");
        }
        result_.of_object.resize(model_.objects.size(), blend_file::as_is);
        result_.of_material.resize(model_.materials.size(), blend_file::as_is);
        // Nodes are filled one after another, however deep they are nested in the text.
        for (std::size_t next = 0; next < defined_.size(); ++next)
            fill(next);
        refuse_cycles();
        return std::move(result_);
    }

private:
    int add(const json_value& blend)
    {
        defined_.push_back(blend.index());
        result_.nodes.emplace_back();
        children_.emplace_back();
        return -static_cast<int>(defined_.size());
    }
    void define(const json_value& blend)
    {
        named& entry = names_[blend.key()];
        if (entry.count > 0)
            blend.fail("the model has a material of this name");
        entry = { add(blend), 1 };
    }

    // A name, or a blend written in its place.
    int child(const json_value& value)
    {
        if (value.is_object())
            return add(value);
        if (!value.is_string())
            value.fail("must be the name of a material or blend, or a blend");
        const auto found = names_.find(value.string());
        if (found == names_.end())
            value.fail("no material or blend named " + in_quotes(value.string()));
        if (found->second.count > 1)
            value.fail("the model has " + std::to_string(found->second.count) + " materials named " + in_quotes(value.string()));
        return found->second.material;
    }

    void fill(std::size_t i)
    {
        const json_value blend = file_.value(defined_[i]);
        blend.allow({ "first", "second", "k", "mask" });
        ao::blend_node node;
        const json_value first = blend.at("first");
        const json_value second = blend.at("second");
        node.first = child(first);
        node.second = child(second);
        children_[i] = { first.index(), second.index() };
        const auto k = blend.find("k");
        const auto mask = blend.find("mask");
        if (k.has_value() == mask.has_value())
            blend.fail(k ? "has both k and mask" : "needs k or mask");
        if (k)
            node.k = k->number(0, 1);
        else
            node.mask = texture(*mask);
        result_.nodes[i] = node;
    }

    int texture(const json_value& mask)
    {
        const std::string& name = mask.string();
        if (name.empty())
            mask.fail("must be the name of a picture");
        const std::string path = (std::filesystem::path(directory_) / name).lexically_normal().string();
        const auto known = masks_.find(path);
        if (known != masks_.end())
            return known->second;
        try {
            return masks_[path] = load_mask_(path);
        } catch (const error& e) {
            mask.fail(e.what());
        }
    }

    std::vector<int> choices(const std::optional<json_value>& table, std::span<const std::string> names, const char* what)
    {
        std::vector<int> chosen(names.size(), blend_file::as_is);
        if (!table)
            return chosen;
        if (!table->is_object())
            table->fail(std::string("must be an object by name of ") + what);
        std::unordered_map<std::string, std::vector<std::size_t>> places;
        for (std::size_t i = 0; i < names.size(); ++i)
            places[names[i]].push_back(i);
        for (const json_value& entry : table->children()) {
            const auto found = places.find(entry.key());
            if (found == places.end())
                entry.fail(std::string("the model has no ") + what + " of this name");
            const int material = child(entry);
            for (const std::size_t i : found->second)
                chosen[i] = material;
        }
        return chosen;
    }

    // Depth first, with a stack of our own.
    void refuse_cycles() const
    {
        enum class state : unsigned char { unseen, open, done };
        struct step {
            std::size_t node;
            int next; // child to look at
        };
        std::vector<state> states(defined_.size(), state::unseen);
        std::vector<step> path;
        for (std::size_t root = 0; root < defined_.size(); ++root) {
            if (states[root] != state::unseen)
                continue;
            states[root] = state::open;
            path.push_back({ root, 0 });
            while (!path.empty()) {
                step& top = path.back();
                if (top.next == 2) {
                    states[top.node] = state::done;
                    path.pop_back();
                    continue;
                }
                const ao::blend_node& node = result_.nodes[top.node];
                const int below = top.next == 0 ? node.first : node.second;
                const std::size_t place = top.next == 0 ? children_[top.node].first : children_[top.node].second;
                ++top.next;
                if (below >= 0)
                    continue;
                const auto child = static_cast<std::size_t>(-1 - below);
                if (states[child] == state::open)
                    report_cycle(path, child, place);
                if (states[child] == state::unseen) {
                    states[child] = state::open;
                    path.push_back({ child, 0 });
                }
            }
        }
    }

    // A cycle goes through names: nothing else leads back to what is open.
    template <class Path>
    [[noreturn]] void report_cycle(const Path& path, std::size_t start, std::size_t place) const
    {
        std::vector<std::string> names;
        bool inside = false;
        for (const auto& step : path) {
            inside = inside || step.node == start;
            const std::string key = file_.value(defined_[step.node]).key();
            const auto found = names_.find(key);
            if (inside && found != names_.end() && found->second.material == -1 - static_cast<int>(step.node))
                names.push_back(key);
        }
        names.push_back(names.front());
        std::string text;
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names.size() > 10 && i == 5) {
                text += " -> ...";
                i = names.size() - 5;
            }
            text += (i == 0 ? "" : " -> ") + one_line(names[i]);
        }
        file_.value(place).fail("a blend contains itself: " + text);
    }

    const json_file& file_;
    std::string directory_;
    model_names model_;
    const mask_loader& load_mask_;
    std::unordered_map<std::string, named> names_;
    std::map<std::string, int> masks_;
    std::vector<std::size_t> defined_;                          // place of each node in the text
    std::vector<std::pair<std::size_t, std::size_t>> children_; // of each node's children
    blend_file result_;
};

} // namespace

blend_file parse_blends(const std::string& name, const std::string& text, const model_names& model, const mask_loader& load_mask)
{
    const json_file file(name, text);
    return reader(file, std::filesystem::path(name).parent_path().string(), model, load_mask).read();
}

blend_file load_blends(const std::string& path, const model_names& model, const mask_loader& load_mask)
{
    return parse_blends(path, json_file::read(path), model, load_mask);
}

} // namespace ao::tools
