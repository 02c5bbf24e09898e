#include "host/spirv_check.hpp"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

// ao_spirv_check FILE.spv…: exit 1 and a line per operation that keeps a shader from being exact.
int main(int count, char** arguments)
{
    if (count < 2) {
        std::fprintf(stderr, "ao_spirv_check: no SPIR-V files named\n");
        return 1;
    }
    std::size_t faults = 0;
    for (int i = 1; i < count; ++i) {
        std::ifstream file(arguments[i], std::ios::binary);
        const std::vector<char> bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
        std::vector<std::uint32_t> words(bytes.size() / 4);
        if (!words.empty())
            std::memcpy(words.data(), bytes.data(), words.size() * 4);
        for (const std::string& fault : ao::host::inexact_operations(words)) {
            std::fprintf(stderr, "%s: %s\n", arguments[i], fault.c_str());
            ++faults;
        }
    }
    std::printf("%d modules, %zu faults\n", count - 1, faults);
    return faults ? 1 : 0;
}
