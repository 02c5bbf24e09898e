#pragma once

#include <string>
#include <vector>

namespace ao::tools {

// The processes that one mpirun started, ours among them; alone where none did, or the program was built without MPI (AO_MPI).
// One object at a time. What is called on it every process must call.
class processes {
public:
    processes();
    processes(const processes&) = delete;
    processes& operator=(const processes&) = delete;
    ~processes();

    [[nodiscard]] std::size_t rank() const { return own; }
    [[nodiscard]] std::size_t size() const { return count; }

    // Those of all, by rank, in the process of rank 0; elsewhere none.
    [[nodiscard]] std::vector<std::string> gather(std::string mine) const;
    // Whether it is so in all.
    [[nodiscard]] bool all(bool here) const;

private:
    std::size_t own = 0;
    std::size_t count = 1;
};

} // namespace ao::tools
