// Forward shading with ambient occlusion as plain data: materials, lights and blend programs packed into one table of words, and
// the passes that shade every pixel of a geometry pass. No API: a shading backend executes it (ao/shading_backend.hpp).
#pragma once

#include "ao/blend.hpp"
#include "ao/plan.hpp"
#include "ao/scene_check.hpp"
#include "ao/shading_passes.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ao {

// What the pictures of a geometry pass are, and what is to be read from them.
struct shade_facts {
    int width = 0; // pixels
    int height = 0;
    bool stored_position = false; // read the position target; else the depth buffer
    pixel_format position_format = pixel_format::rgba32f;
    pixel_format depth_format = pixel_format::d32f;
    normal_source normals = normal_source::vector; // any but from_depth
    pixel_format normal_format = pixel_format::rgba16f;
    bool parallel = false;
    bool visibility = true;                              // else everything counts as open
    pixel_format visibility_format = pixel_format::r32f; // or r8; rgba16f, and only that, with bent_normal
    bool bent_normal = false;  // look ambient light up along the bent normal that comes with visibility; needs visibility
    bool multi_bounce = false; // tint visibility by the diffuse reflectance (ao_bounced_visibility); needs visibility
};

struct shade_camera {
    camera_projection projection;
    matrix4 view; // world to view space, a rotation and a translation
};

// Options of the pass bodies (ao_use_maps ... of ao/shared/shade_pass.h). What is off is neither bound nor read.
struct shade_options {
    bool stored_position = false;
    bool parallel = false;
    int normal_source = 0;
    bool visibility = false;
    bool maps = false;        // reads the heap and the surface target
    bool reflections = false; // reads the heap
    bool frames = false;      // reads the frame target; only with maps
    bool blends = false;
    bool bent_normal = false;
    bool multi_bounce = false;

    friend constexpr bool operator==(const shade_options&, const shade_options&) = default;
};

using shade_constants = shading_pass<float, no_resources>::ao_shade_constants;
static_assert(sizeof(shade_constants) == 128);

enum class shade_pass_type {
    shade,   // ao_shade_pass: writes every pixel of `color`
    segment, // ao_segment_pass: part of one blend; writes where the result's w is not negative
};

struct shade_pass {
    shade_pass_type type{};
    int output = blend_result; // `color`, or a target: rgba32f of the picture's size, read and written at the own pixel
    shade_constants constants{};
};

struct shade_plan {
    shade_facts facts;
    shade_options options;             // of all passes
    std::vector<shade_pass> passes;    // in order; each may read what those before it wrote
    std::vector<std::uint32_t> words;  // the table: ao/shared/shade_tables.h
    int targets = 0;                   // between segments
    std::vector<blend_program> blends; // of the blends that objects use

    std::size_t target_bytes() const
    {
        return static_cast<std::size_t>(targets) * static_cast<std::size_t>(facts.width) *
               static_cast<std::size_t>(facts.height) * 16;
    }
};

namespace detail {

using shade_layout = shading_pass<float, no_resources>;
static_assert(shade_layout::ao_register_limit == most_registers);

constexpr std::optional<error> validate(const shade_facts& f)
{
    facts as_read;
    as_read.width = f.width;
    as_read.height = f.height;
    as_read.depth = f.stored_position ? depth_source::position : depth_source::hardware;
    as_read.depth_format = f.stored_position ? f.position_format : f.depth_format;
    as_read.normals = f.normals;
    as_read.normal_format = f.normal_format;
    as_read.output_format = f.visibility_format;
    if (f.normals == normal_source::from_depth) {
        return error(errc::unsupported_format, "shading needs stored normals");
    }
    if ((f.bent_normal || f.multi_bounce) && !f.visibility) {
        return error(errc::invalid_settings, f.bent_normal ? "bent normals come with a visibility" : "bounces need a visibility");
    }
    return validate(as_read, f.bent_normal);
}

class word_writer {
public:
    std::size_t size() const { return words.size(); }
    void add(std::uint32_t n) { words.push_back(n); }
    void add(int n) { words.push_back(static_cast<std::uint32_t>(n)); }
    void add(std::size_t n) { words.push_back(static_cast<std::uint32_t>(n)); }
    void add(float x) { words.push_back(std::bit_cast<std::uint32_t>(x)); }
    void add(const glm::vec3& v)
    {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void set(int header, std::size_t n) { words[static_cast<std::size_t>(header)] = static_cast<std::uint32_t>(n); }

    std::vector<std::uint32_t> words;
};

inline void write(word_writer& w, const standard_material& m)
{
    const std::size_t start = w.size();
    w.add(m.ambient);
    w.add(m.shininess);
    w.add(m.diffuse);
    w.add(m.model == specular_model::phong ? 1 : 0);
    w.add(m.specular);
    w.add(m.normal_green_down ? -1.0F : 1.0F);
    w.add(m.emission);
    // A reflection is as blurred as the highlight: full width of the cone whose cosine's power has fallen to 1 / e, in turns.
    const double width = std::sqrt(2 / (static_cast<double>(m.shininess) + 2)) / pi;
    w.add(static_cast<float>(width * width));
    w.add(m.repeat.x);
    w.add(m.repeat.y);
    w.add(std::max(m.repeat.x * m.repeat.x, m.repeat.y * m.repeat.y));
    for (const int map : { m.diffuse_map, m.specular_map, m.reflection_map, m.normal_map }) {
        w.add(map + 1);
    }
    w.add(0);
    assert(w.size() - start == static_cast<std::size_t>(shade_layout::ao_material_words));
    static_cast<void>(start);
}

inline void write(word_writer& w, const light& l)
{
    glm::vec3 vector = l.vector;
    if (l.type == light_type::directional) {
        const glm::dvec3 exact(vector);
        const double norm = std::sqrt(exact.x * exact.x + exact.y * exact.y + exact.z * exact.z);
        vector = norm > 0 ? glm::vec3(exact / norm) : glm::vec3(0.0F); // a light without direction lights nothing
    }
    w.add(vector);
    w.add(l.type == light_type::point ? 1 : 0);
    w.add(l.color);
    w.add(0);
    w.add(l.attenuation);
    w.add(0);
}

// How a leaf of a blend comes by its normal.
inline int normal_kind(const scene& s, const material_needs& needs, int leaf)
{
    const standard_material& own = s.materials[static_cast<std::size_t>(leaf)];
    if (!needs.frame || same_normal_map(own, s.materials[static_cast<std::size_t>(needs.geometry)])) {
        return shade_layout::ao_normal_of_geometry;
    }
    return own.normal_map == no_texture ? shade_layout::ao_normal_of_surface : shade_layout::ao_normal_of_map;
}

inline void write(word_writer& w, const scene& s, const material_needs& needs, const blend_instruction& i)
{
    const auto code = [&](int operation) { return operation + 256 * i.target + 65536 * i.first + 16777216 * i.second; };
    if (i.operation == blend_operation::leaf) {
        w.add(code(shade_layout::ao_leaf));
        w.add(i.source);
        w.add(normal_kind(s, needs, i.source));
    }
    else if (i.operation == blend_operation::mix) {
        w.add(code(shade_layout::ao_mix));
        w.add(i.source);
        w.add(s.blends[static_cast<std::size_t>(i.source)].mask + 1);
    }
    else {
        w.add(code(shade_layout::ao_fetch));
        w.add(i.source);
        w.add(0);
    }
    w.add(0);
}

// Materials and blends that objects use, as indices into table entries: materials, then blends.
inline std::vector<char> used_entries(const scene& s)
{
    std::vector<char> used(s.materials.size() + s.blends.size());
    for (const object& o : s.objects) {
        used[o.material >= 0 ? static_cast<std::size_t>(o.material) : s.materials.size() + blend_index(o.material)] = 1;
    }
    return used;
}

inline void add_leaf_options(shade_options& o, const standard_material& m)
{
    o.maps = o.maps || m.diffuse_map != no_texture || m.specular_map != no_texture;
    o.reflections = o.reflections || m.reflection_map != no_texture;
}

inline void add_options(shade_options& o, const scene& s, const blend_program& p)
{
    o.blends = true;
    for (const blend_instruction& i : p.instructions) {
        if (i.operation == blend_operation::leaf) {
            add_leaf_options(o, s.materials[static_cast<std::size_t>(i.source)]);
        }
        else if (i.operation == blend_operation::mix) {
            o.maps = o.maps || s.blends[static_cast<std::size_t>(i.source)].mask != no_texture;
        }
    }
}

} // namespace detail

// Rewrites the constants for this frame's camera; nothing is allocated.
inline std::optional<error> update(shade_plan& p, const shade_camera& camera)
{
    const result<projection_constants> folded = fold_projection(camera.projection, p.facts.width, p.facts.height, max_eye_depth);
    if (!folded) {
        return folded.error();
    }
    if (folded->parallel != p.facts.parallel) {
        return error(errc::invalid_projection, "the plan and the camera differ in being parallel");
    }
    const auto at = [&](int row, int column) { return static_cast<double>(camera.view[column][row]); };
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const double product = at(0, i) * at(0, j) + at(1, i) * at(1, j) + at(2, i) * at(2, j);
            if (!(std::abs(product - (i == j ? 1 : 0)) < 1e-3)) {
                return error(errc::invalid_projection, "the view matrix is not a rotation and a translation");
            }
        }
    }
    for (shade_pass& pass : p.passes) {
        pass.constants.projection = std::bit_cast<decltype(pass.constants.projection)>(folded->projection);
        pass.constants.decode = std::bit_cast<decltype(pass.constants.decode)>(folded->decode);
        const auto row = [&](int i) {
            const double eye = -(at(0, i) * at(0, 3) + at(1, i) * at(1, 3) + at(2, i) * at(2, 3));
            return glm::vec4(at(0, i), at(1, i), at(2, i), eye);
        };
        pass.constants.view_to_world = { row(0), row(1), row(2) };
    }
    return std::nullopt;
}

// Rewrites the lights and the ambient light of the table. Precondition: as many lights as the plan was made with.
inline void set_lights(shade_plan& p, const scene& s)
{
    using layout = detail::shade_layout;
    assert(s.lights.size() == p.words[layout::ao_header_light_count]);
    detail::word_writer w;
    for (const light& l : s.lights) {
        detail::write(w, l);
    }
    std::copy(w.words.begin(), w.words.end(), p.words.begin() + static_cast<std::ptrdiff_t>(p.words[layout::ao_header_lights]));
    w.words.clear();
    for (const glm::vec3& c : s.ambient.coefficients) {
        w.add(c);
    }
    std::copy(w.words.begin(), w.words.end(), p.words.begin() + static_cast<std::ptrdiff_t>(p.words[layout::ao_header_ambient]));
}

// Sets k of a blend node in the table. What is outside [0, 1] or NaN is clamped and counted when it is shaded with.
// Precondition: the plan was made without blend_settings::fixed_k.
inline void set_weight(shade_plan& p, int node, float k)
{
    p.words[p.words[detail::shade_layout::ao_header_weights] + static_cast<std::size_t>(node)] = std::bit_cast<std::uint32_t>(k);
}

// Fails as validate(scene) and fold_projection do, and for formats that do not fit.
inline result<shade_plan> make_shade_plan(const scene& s, const shade_facts& f, const shade_camera& camera,
                                          const blend_settings& settings = {})
{
    using layout = detail::shade_layout;
    if (const auto wrong = detail::validate(f)) {
        return *wrong;
    }
    if (const auto wrong = validate(s)) {
        return *wrong;
    }
    auto planner = blend_planner::create(s, settings);
    if (!planner) {
        return planner.error();
    }
    shade_plan plan;
    plan.facts = f;
    plan.options.stored_position = f.stored_position;
    plan.options.parallel = f.parallel;
    plan.options.normal_source = static_cast<int>(f.normals);
    plan.options.visibility = f.visibility;
    plan.options.bent_normal = f.bent_normal;
    plan.options.multi_bounce = f.multi_bounce;

    detail::word_writer w;
    w.words.resize(static_cast<std::size_t>(layout::ao_header_words), 0);
    w.set(layout::ao_header_materials, w.size());
    w.set(layout::ao_header_material_count, s.materials.size());
    for (const standard_material& m : s.materials) {
        detail::write(w, m);
    }
    w.set(layout::ao_header_lights, w.size());
    w.set(layout::ao_header_light_count, s.lights.size());
    for (const light& l : s.lights) {
        detail::write(w, l);
    }
    w.set(layout::ao_header_ambient, w.size());
    for (const glm::vec3& c : s.ambient.coefficients) {
        w.add(c);
    }
    w.set(layout::ao_header_weights, w.size());
    for (const blend_node& b : s.blends) {
        w.add(b.k);
    }
    const std::size_t entries = w.size();
    const std::size_t entry_count = s.materials.size() + s.blends.size();
    w.set(layout::ao_header_entries, entries);
    w.set(layout::ao_header_entry_count, entry_count);
    w.words.resize(entries + 2 * entry_count, 0);

    plan.passes.push_back({});
    const material_table needs(s);
    const std::vector<char> used = detail::used_entries(s);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] == 0) {
            continue;
        }
        if (i < s.materials.size()) {
            detail::add_leaf_options(plan.options, s.materials[i]);
            continue;
        }
        const int root = static_cast<int>(i - s.materials.size());
        const material_needs& own = needs[-1 - root];
        blend_program program = planner->program(root);
        detail::add_options(plan.options, s, program);
        plan.options.frames = plan.options.frames || own.frame;
        plan.options.maps = plan.options.maps || own.frame;
        const std::size_t first = w.size();
        for (const blend_instruction& instruction : program.instructions) {
            detail::write(w, s, own, instruction);
        }
        if (program.fused()) {
            w.words[entries + 2 * i] = static_cast<std::uint32_t>(first);
            w.words[entries + 2 * i + 1] = static_cast<std::uint32_t>(program.instructions.size());
        }
        else {
            for (const blend_segment& segment : program.segments) {
                shade_pass pass;
                pass.type = shade_pass_type::segment;
                pass.output = segment.output;
                pass.constants.root = static_cast<float>(root);
                pass.constants.first = static_cast<float>(first + segment.first * layout::ao_instruction_words);
                pass.constants.count = static_cast<float>(segment.count);
                plan.passes.push_back(pass);
            }
            plan.targets = std::max(plan.targets, program.pictures);
        }
        plan.blends.push_back(std::move(program));
    }
    plan.words = std::move(w.words);
    if (plan.words.size() > 1U << 24U) {
        return error(errc::invalid_scene, "materials and blends need a table of more than 2^24 words");
    }
    if (const auto wrong = update(plan, camera)) {
        return *wrong;
    }
    return plan;
}

// What was chosen for each blend, and what it costs.
inline std::string explain(const shade_plan& p)
{
    const auto number = [](auto n, const char* one, const char* many) { return std::to_string(n) + " " + (n == 1 ? one : many); };
    std::string text = number(p.passes.size(), "pass", "passes") + ", " + number(p.targets, "target", "targets") + " of " +
                       std::to_string(p.target_bytes()) + " bytes together, table of " + std::to_string(p.words.size() * 4) +
                       " bytes\n";
    for (const blend_program& b : p.blends) {
        text += "blend " + std::to_string(b.root) + ": " + number(b.leaves, "leaf", "leaves") + ", " +
                number(b.mixes, "blend", "blends") + "; " +
                (b.fused()
                     ? "in the shading pass, "
                     : number(b.passes(), "pass", "passes") + " of its own, " + number(b.pictures, "target", "targets") + ", ") +
                number(b.registers, "register", "registers") + "; a picture per leaf would take " +
                number(b.paper_passes(), "pass", "passes") + " and " + number(b.label, "target", "targets") + "\n";
    }
    return text;
}

} // namespace ao
