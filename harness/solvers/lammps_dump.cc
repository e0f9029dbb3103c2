#include "harness/solvers/lammps_dump.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "harness/io/errors.h"

namespace ddem::harness {

void read_dump(const std::filesystem::path& path, std::size_t discs, std::size_t values,
               const std::function<void(std::size_t, std::span<const double>)>& disc, const std::function<void()>& frame) {
  std::ifstream file(path);
  std::vector<double> row(values);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("ITEM: NUMBER")) continue;
    std::size_t count = 0;
    file >> count;
    while (std::getline(file, line) && !line.starts_with("ITEM: ATOMS")) {}
    std::size_t id = 0;
    std::string word;
    for (std::size_t k = 0; k < count; ++k) {
      bool whole = static_cast<bool>(file >> id) && id >= 1 && id <= discs;
      for (std::size_t c = 0; whole && c < values; ++c) {
        whole = static_cast<bool>(file >> word);  // strtod reads nan and inf, as LAMMPS writes them
        row[c] = std::strtod(word.c_str(), nullptr);
      }
      if (!whole) throw InputError("its motion cannot be read");
      disc(id - 1, row);
    }
    frame();
  }
}

}  // namespace ddem::harness
