// A real mesh, some of its vertices, and what they are known to be: rules are held against that.
#pragma once

#include "sweep/bake_rules_study.hpp"

#include "ao/bake.hpp"
#include "ao/cpu/bake.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class rule_mesh {
public:
    static constexpr std::size_t looked_at = 192; // vertices, evenly picked from those of the file
    static constexpr int reference_sets = 2;
    static constexpr int reference_directions = 400'009;

    rule_mesh(std::string name, const std::string& path, ao::cpu::baker& baker);

    const std::string& name() const { return name_; }
    std::size_t triangles() const { return indices_.size() / 3; }

    // Standard error of what the vertices are known to be, root mean square, from how far the reference's sets are apart.
    double reference_error(ao::bake_coefficient c) const { return reference_error_[static_cast<std::size_t>(c)]; }

    // Of the rules together, which are different sets of as many directions.
    rule_point measure(const std::vector<ao::sphere_rule>& rules, int directions, ao::bake_coefficient coefficient);

private:
    ao::bake_input input() const { return { positions_, normals_, indices_, {} }; }
    void load(const std::string& path);
    void find_reference();
    ao::bake_sums sums_of(const ao::bake_job& job);

    std::string name_;
    ao::cpu::baker& baker_;
    // Those looked at come first.
    std::vector<glm::dvec3> positions_;
    std::vector<glm::vec3> normals_;
    std::vector<std::uint32_t> indices_;
    std::array<std::vector<double>, 2> reference_; // by coefficient
    std::array<double, 2> reference_error_{};
};
