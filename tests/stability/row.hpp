// The stability suite: every row of the catalogue of failures as a measured assertion, known to bite. A row measures one figure
// of a subject (a backend) and holds it against a bound; of the same subject with a fault in it, the bound must not hold.
#pragma once

#include "stability/subject.hpp"

#include <string>
#include <vector>

namespace stability {

// What a row needs of a subject. core: nothing; measured once.
enum class domain { core, passes, temporal, scene, bake };

struct row {
    const char* id;
    const char* input; // what is measured over what
    double bound;
    bool at_least;      // the figure must be the bound or more, else the bound or less
    const char* source; // where the bound comes from
    domain needs;
    double (*measure)(subject&);
    const char* fault;       // in words: a published method that must fail, or a planted fault
    void (*spoil)(subject&); // brings it about
    // The bound is a goal that is known to be missed; the row says by how much, and fails once it is met.
    bool missed = false;
};

// NaN holds no bound.
inline bool holds(const row& r, double figure)
{
    return r.at_least ? figure >= r.bound : figure <= r.bound;
}

// A row of the catalogue that has no measurement of its own: why, or which rows cover it.
struct remark {
    const char* id;
    const char* reason;
};

std::vector<row> frame_rows();    // 4.1
std::vector<row> sequence_rows(); // 4.2
std::vector<row> warp_rows();     // 4.3
std::vector<row> depth_rows();    // 4.4
std::vector<row> screen_rows();   // 4.5
std::vector<row> poison_rows();   // 4.6
std::vector<row> history_rows();  // 4.7: F1 to F4, F7
std::vector<row> motion_rows();   // 4.7: F5, F6, F8, F9
std::vector<row> filter_rows();   // 4.8
std::vector<row> ray_rows();      // 4.9
std::vector<row> material_rows(); // 4.10
std::vector<row> repeat_rows();   // 4.11, 4.12
std::vector<row> field_rows();    // 7
std::vector<row> all_rows();
std::vector<remark> all_remarks();

} // namespace stability
