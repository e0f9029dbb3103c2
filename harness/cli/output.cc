#include "harness/cli/output.h"

#include "harness/io/hdf5.h"
#include "harness/provenance/provenance.h"

namespace ddem::harness {

void add_probe(SignalTable& table, const std::string& name, const std::vector<double>& ux, const std::vector<double>& uy,
               const std::vector<double>* theta) {
  const auto add = [&](const char* suffix, const std::vector<double>& values) {
    table.names.push_back(name + suffix);
    table.channels.push_back(values);
  };
  add("_ux", ux);
  add("_uy", uy);
  if (theta != nullptr) add("_theta", *theta);
}

void write_signals_hdf5(const std::string& path, const SignalTable& table, const Scene& scene, const MoreGroups& more) {
  Hdf5File file = Hdf5File::create(path);
  {
    Hdf5Group root = file.root();
    root.set_attribute("scene", scene.source_text);
    for (const auto& [key, value] : provenance()) root.set_attribute(key, value);
    if (const auto* random = std::get_if<RandomPacking>(&scene.assembly.packing)) root.set_attribute("seed", random->seed);
    Hdf5Group signals = root.create_group("signals");
    signals.write("time", table.time).set_attribute("unit", "s");
    for (std::size_t c = 0; c < table.names.size(); ++c) {
      signals.write(table.names[c], table.channels[c]).set_attribute("unit", table.names[c].ends_with("_theta") ? "rad" : "m");
    }
    more(root);
  }
  file.close();
}

void write_outputs(const std::string& hdf5_path, const std::string& csv_path, const SignalTable& table, const Scene& scene,
                   const MoreGroups& more) {
  if (!csv_path.empty()) write_signals_csv(csv_path, table);
  if (!hdf5_path.empty()) write_signals_hdf5(hdf5_path, table, scene, more);
}

}  // namespace ddem::harness
