// Ambient occlusion per vertex (ao/bake.hpp) on the CPU, on all cores. Routes: raster, hierarchy, brute, and embree where the
// library was built with it. Width::scalar runs the shared bodies for one value at a time: the reference.
//
// Memory: 40 bytes a triangle and 80 a vertex, and per thread 12 bytes a point and about 110 a vertex for raster; 36 bytes a
// triangle more for brute. Results are the same bits for every width, number of threads and division into parts, and for every
// route but embree.
#pragma once

#include "ao/bake.hpp"
#include "ao/cpu/backend.hpp"

#include <memory>

namespace ao::cpu {

class baker {
public:
    // errc::device where the width is not available, errc::invalid_settings for negative numbers.
    static result<baker> create(const options& o = {});

    baker(baker&&) noexcept;
    baker& operator=(baker&&) noexcept;
    ~baker();

    // What was chosen.
    width lanes() const;
    int threads() const;

    // Whether run() takes this route; true of automatic.
    static bool has(bake_route route);

    // errc::unsupported_format: a route that this backend does not have, or not for these settings; errc::invalid_settings: a
    // part that is none; errc::out_of_memory. Where progress ends the bake the sums cover what was done.
    result<bake_sums> run(const bake_job& job, const bake_request& request = {});

private:
    struct state;
    explicit baker(std::unique_ptr<state> s);
    std::unique_ptr<state> state_;
};

} // namespace ao::cpu
