// The work of `jkroll batch` as a single-threaded program for one table. It reads nine columns of bare numbers, and writes
// the same lines with all results appended. It knows no units, materials, quotes or bad rows: the least work. Built with
// -O2.
//
// formulas.h is made from formulas.txt by rivals.py: a constant for each line, and RESULTS, their names in order.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t chunk = 1 << 20;
constexpr std::size_t longest = 1 << 12;  // of a line with its results

const char *number(const char *from, const char *end, double &value) {
    return std::from_chars(from, end, value).ptr + 1;
}

char *put(char *to, double value) {
    *to++ = ',';
    return std::to_chars(to, to + 32, value).ptr;
}

char *convert(const char *line, const char *end, char *to) {
    double radius, radius2, surface_energy, youngs_modulus, poisson_ratio, density, yield_displacement, load;
    const char *cell = static_cast<const char *>(std::memchr(line, ',', end - line)) + 1;
    cell = number(cell, end, radius);
    cell = number(cell, end, radius2);
    cell = number(cell, end, surface_energy);
    cell = number(cell, end, youngs_modulus);
    cell = number(cell, end, poisson_ratio);
    cell = number(cell, end, density);
    cell = number(cell, end, yield_displacement);
    number(cell, end, load);
    radius /= 1e9;
    radius2 /= 1e9;
    surface_energy /= 1e3;
    youngs_modulus *= 1e9;
    density *= 1e3;
    yield_displacement /= 1e9;
    load /= 1e9;
    using std::cbrt, std::fmax, std::fmin, std::sqrt;
#include "formulas.h"
    to = std::copy(line, end, to);
    for (double value : {RESULTS}) to = put(to, value);
    *to++ = ',';
    *to++ = '\n';
    return to;
}

}  // namespace

int main() {
    std::vector<char> in(chunk + longest), out(chunk * 16);
    std::size_t kept = 0;
    bool is_header = true;
    while (std::size_t size = std::fread(in.data() + kept, 1, chunk, stdin)) {
        const char *line = in.data(), *end = in.data() + kept + size;
        char *to = out.data();
        while (const char *stop = static_cast<const char *>(std::memchr(line, '\n', end - line))) {
            if (is_header) {
                to = std::copy(line, stop, to);
                for (const char *name : {NAMES}) to = std::copy(name, name + std::strlen(name), to);
                to = std::copy_n(",status\n", 8, to);
                is_header = false;
            } else {
                to = convert(line, stop, to);
            }
            line = stop + 1;
        }
        kept = end - line;
        std::memmove(in.data(), line, kept);
        if (std::fwrite(out.data(), 1, to - out.data(), stdout) != static_cast<std::size_t>(to - out.data())) return 1;
    }
    return 0;
}
