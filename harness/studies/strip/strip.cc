#include "harness/studies/strip/strip.h"

#include <algorithm>

#include "harness/io/data_json.h"
#include "harness/studies/waves/waves_run.h"

namespace ddem::harness {
namespace {

/// Keeps the models and ratios of the cases that are judged, so that the whole of what they compare is drawn, and no more. Cases
/// that name none have models and ratios of their own.
StripCampaign narrowed(const StripCampaign& s, std::span<const std::string> cases) {
  StripCampaign out = s;
  const auto is_judged = [&](Model m, double ratio) {
    return std::ranges::any_of(cases, [tail = "/" + material_slug(m, ratio)](const std::string& id) { return id.ends_with(tail); });
  };
  std::erase_if(out.models, [&](Model m) {
    return std::ranges::none_of(s.stiffness_ratios, [&](double ratio) { return is_judged(m, ratio); });
  });
  std::erase_if(out.stiffness_ratios, [&](double ratio) {
    return std::ranges::none_of(s.models, [&](Model m) { return is_judged(m, ratio); });
  });
  return out.models.empty() ? s : out;
}

}  // namespace

std::shared_ptr<Strip> strip_of(const StudyContext& context) {
  return context.shared.get<Strip>([&] {
    const auto spec = context.tables.at("strip").get<StripCampaign>();
    return std::make_shared<Strip>(narrowed(spec, context.only), context.options);
  });
}

std::string inputs_of(StripCampaign s) {
  s.title.clear();
  return nlohmann::json(s).dump();
}

std::string inputs_of(const StripCampaign& s, const StripMaterial& m) {
  StripCampaign alone = s;
  alone.title.clear();
  alone.models = {m.model};
  alone.stiffness_ratios = {m.stiffness_ratio};
  alone.seeds = {m.seed};
  alone.full_stability = false;
  nlohmann::json inputs = alone;
  inputs["solved_as"] = continuum_model(s, m.model);
  inputs["for_figures"] = {m.seed == s.seeds.front(), shows_strip(s, m), m.stiffness_ratio == shown_ratio(s)};
  return inputs.dump();
}

std::string statics_unit(const StripMaterial& m) {
  return "statics/" + slug_of(m);
}

std::string waves_unit(const StripMaterial& m, Protocol protocol) {
  return (protocol == Protocol::paper ? "paper/" : "waves/") + slug_of(m);
}

std::vector<StripMaterial> all_seeds(const StripCampaign& s, StripMaterial m) {
  std::vector<StripMaterial> all;
  for (const std::int64_t seed : s.seeds) {
    m.seed = seed;
    all.push_back(m);
  }
  return all;
}

std::vector<StripMaterial> contacts_of(const StripCampaign& s, StripPacking packing) {
  std::vector<StripMaterial> all;
  for (const StripMaterial& m : materials_of(s)) {
    if (m.packing == packing && (packing == StripPacking::hexagonal || m.seed == s.seeds.front())) all.push_back(m);
  }
  return all;
}

}  // namespace ddem::harness
