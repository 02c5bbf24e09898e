#include "ao/processes.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#ifdef AO_HAS_MPI
#define OMPI_SKIP_MPICXX
#include <mpi.h>
#endif

namespace ao::tools {

#ifdef AO_HAS_MPI

namespace {

constexpr std::size_t largest_message = std::size_t{ 1 } << 30;

bool started()
{
    int is = 0;
    MPI_Initialized(&is);
    return is != 0;
}

// Each piece is (bytes, how many).
template <class Each>
void in_pieces(char* bytes, std::size_t size, const Each& each)
{
    for (std::size_t at = 0; at < size; at += largest_message)
        each(bytes + at, static_cast<int>(std::min(size - at, largest_message)));
}

} // namespace

processes::processes()
{
    // Open MPI's launcher, and those that speak PMI: without one there is nobody to talk to.
    if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr && std::getenv("PMI_SIZE") == nullptr)
        return;
    MPI_Init(nullptr, nullptr);
    int rank = 0, size = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    own = static_cast<std::size_t>(rank);
    count = static_cast<std::size_t>(size);
}

processes::~processes()
{
    if (started())
        MPI_Finalize();
}

std::vector<std::string> processes::gather(std::string mine) const
{
    if (own > 0) {
        std::uint64_t size = mine.size();
        MPI_Send(&size, 1, MPI_UINT64_T, 0, 0, MPI_COMM_WORLD);
        in_pieces(mine.data(), mine.size(), [](char* bytes, int n) { MPI_Send(bytes, n, MPI_CHAR, 0, 1, MPI_COMM_WORLD); });
        return {};
    }
    std::vector<std::string> all{ std::move(mine) };
    for (std::size_t i = 1; i < count; ++i) {
        const int from = static_cast<int>(i);
        std::uint64_t size = 0;
        MPI_Recv(&size, 1, MPI_UINT64_T, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        std::string bytes(static_cast<std::size_t>(size), '\0');
        in_pieces(bytes.data(), bytes.size(),
                  [&](char* to, int n) { MPI_Recv(to, n, MPI_CHAR, from, 1, MPI_COMM_WORLD, MPI_STATUS_IGNORE); });
        all.push_back(std::move(bytes));
    }
    return all;
}

bool processes::all(bool here) const
{
    int mine = here ? 1 : 0, least = mine;
    if (started())
        MPI_Allreduce(&mine, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    return least != 0;
}

#else

processes::processes() = default;
processes::~processes() = default;

std::vector<std::string> processes::gather(std::string mine) const
{
    return { std::move(mine) };
}

bool processes::all(bool here) const
{
    return here;
}

#endif

} // namespace ao::tools
