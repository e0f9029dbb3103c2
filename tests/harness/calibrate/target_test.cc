// Targets from moduli and velocities: closed forms of plane elasticity and of the solid.
#include "harness/calibrate/target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

using testing::HasSubstr;

struct Solid {
  double young = 31e9, poisson = 0.0, density = 2400.0;
  double bar() const { return std::sqrt(young / density); }
  double shear() const { return std::sqrt(young / (2.0 * (1.0 + poisson) * density)); }
  double p(Plane plane) const {
    const double modulus = plane == Plane::stress
                               ? young / (1.0 - poisson * poisson)
                               : young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    return std::sqrt(modulus / density);
  }
  double of(TargetKind kind, Plane plane) const {
    switch (kind) {
      case TargetKind::young:
        return young;
      case TargetKind::poisson:
        return poisson;
      case TargetKind::bar:
        return bar();
      case TargetKind::shear:
        return shear();
      case TargetKind::p:
        break;
    }
    return p(plane);
  }
};

WantedValues wanted(const Solid& s, Plane plane, const std::vector<TargetKind>& kinds) {
  WantedValues w;
  w.plane = plane;
  w.density = s.density;
  for (const TargetKind kind : kinds) w.of(kind) = Uncertain{s.of(kind, plane), 0.0};
  return w;
}

/// Round-off of logarithms and the least squares: 1e-15 over the slopes, which are as small as nu for bar and
/// P.
TEST(Target, AnyTwoOrMoreValuesGiveTheSolid) {
  for (const Plane plane : {Plane::stress, Plane::strain}) {
    for (const double nu : {-0.3, 0.1, 0.25, 0.45}) {
      const Solid s{.poisson = nu};
      for (int kinds = 1; kinds < 32; ++kinds) {
        std::vector<TargetKind> chosen;
        for (std::size_t k = 0; k < kTargetKinds.size(); ++k) {
          if (kinds >> k & 1) chosen.push_back(kTargetKinds[k]);
        }
        const bool sign_open =
            nu < 0.0 && (kinds == 0b10100 || kinds == 0b10001 || kinds == 0b10101);  // P with E or bar alone
        if (chosen.size() < 2 || kinds == 0b00101 || sign_open) continue;
        const Target t = make_target(wanted(s, plane, chosen));
        EXPECT_NEAR(t.solid_poisson_ratio, nu, 1e-10) << kinds;
        EXPECT_NEAR(t.solid_young_modulus / s.young, 1.0, 1e-10) << kinds;
      }
    }
  }
}

TEST(Target, PlaneStrainConvertsTheSolid) {
  const Target t =
      make_target(wanted({.poisson = 0.25}, Plane::strain, {TargetKind::young, TargetKind::poisson}));
  EXPECT_DOUBLE_EQ(t.young_modulus, 31e9 / (1.0 - 0.0625));
  EXPECT_DOUBLE_EQ(t.poisson_ratio, 1.0 / 3.0);
  EXPECT_THAT(t.conversion, HasSubstr("E/(1 - nu^2)"));
  const Target same =
      make_target(wanted({.poisson = 0.25}, Plane::stress, {TargetKind::young, TargetKind::poisson}));
  EXPECT_EQ(same.young_modulus, 31e9);
  EXPECT_EQ(same.poisson_ratio, 0.25);
}

/// Bar and P velocity leave the sign of nu open.
TEST(Target, TakesThePositiveSignWhereItIsOpen) {
  const Target t = make_target(wanted({.poisson = -0.3}, Plane::stress, {TargetKind::bar, TargetKind::p}));
  EXPECT_NEAR(t.poisson_ratio, 0.3, 1e-10);
}

/// Theory: d(nu) = 2 (1 + nu) (d_bar - d_shear), 2 (1 - nu) (d_p - d_shear), independent relative errors d.
TEST(Target, PropagatesUncertainty) {
  const Solid s{.poisson = 0.25};
  WantedValues w = wanted(s, Plane::stress, {TargetKind::bar, TargetKind::shear});
  w.of(TargetKind::bar)->stddev = 0.01 * s.bar();
  w.of(TargetKind::shear)->stddev = 0.02 * s.shear();
  Target t = make_target(w);
  EXPECT_NEAR(std::sqrt(t.covariance(1, 1)), 2.0 * 1.25 * std::hypot(0.01, 0.02), 1e-9);
  EXPECT_NEAR(std::sqrt(t.covariance(0, 0)), 0.02, 1e-9);  // E = rho c_bar^2
  EXPECT_NEAR(t.covariance(0, 1), 0.02 * 2.0 * 1.25 * 0.01, 1e-9);
  w = wanted(s, Plane::stress, {TargetKind::p, TargetKind::shear});
  w.of(TargetKind::p)->stddev = 0.01 * s.p(Plane::stress);
  t = make_target(w);
  EXPECT_NEAR(std::sqrt(t.covariance(1, 1)), 2.0 * 0.75 * 0.01, 1e-9);
  // Plane strain: nu/(1 - nu) changes by d(nu)/(1 - nu)^2.
  w = wanted(s, Plane::strain, {TargetKind::young, TargetKind::poisson});
  w.of(TargetKind::poisson)->stddev = 0.01;
  EXPECT_NEAR(std::sqrt(make_target(w).covariance(1, 1)), 0.01 / 0.5625, 1e-12);
}

/// Three values: the more certain ones count for more, and disagreement within three uncertainties is none.
TEST(Target, WeighsByUncertainty) {
  const Solid s{.poisson = 0.25};
  WantedValues w = wanted(s, Plane::stress, {TargetKind::bar, TargetKind::shear, TargetKind::poisson});
  w.of(TargetKind::poisson) = Uncertain{0.30, 0.1};
  w.of(TargetKind::bar)->stddev = w.of(TargetKind::shear)->stddev = 1e-4;
  EXPECT_NEAR(make_target(w).poisson_ratio, 0.25, 1e-6);
  w.of(TargetKind::poisson) = Uncertain{0.30, 0.01};
  EXPECT_THROW(make_target(w), InputError);
}

std::string refusal(const WantedValues& w) {
  try {
    make_target(w);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Target, RefusesWhatNoMaterialHas) {
  const auto with = [](std::initializer_list<std::pair<TargetKind, double>> values,
                       Plane plane = Plane::stress, std::optional<double> density = 2400.0) {
    WantedValues w;
    w.plane = plane;
    w.density = density;
    for (const auto& [kind, value] : values) w.of(kind) = Uncertain{value, 0.0};
    return w;
  };
  using K = TargetKind;
  EXPECT_THAT(refusal(with({{K::young, -1.0}, {K::poisson, 0.2}})), HasSubstr("must be positive"));
  EXPECT_THAT(refusal(with({{K::young, NAN}, {K::poisson, 0.2}})), HasSubstr("must be positive and finite"));
  EXPECT_THAT(refusal(with({{K::young, 3e10}, {K::poisson, NAN}})), HasSubstr("must lie between -1 and 1"));
  EXPECT_THAT(refusal(with({{K::young, 3e10}, {K::poisson, 1.0}})), HasSubstr("must lie between -1 and 1"));
  EXPECT_THAT(refusal(with({{K::young, 3e10}, {K::poisson, 0.5}}, Plane::strain)),
              HasSubstr("must lie between -1 and 0.5"));
  EXPECT_THAT(refusal(with({{K::young, 3e10}})), HasSubstr("two targets"));
  EXPECT_THAT(refusal(with({{K::young, 3e10}, {K::shear, 2000.0}}, Plane::stress, std::nullopt)),
              HasSubstr("need --density"));
  EXPECT_THAT(refusal(with({{K::young, 3e10}, {K::bar, 2000.0}})), HasSubstr("say the same"));
  EXPECT_THAT(refusal(with({{K::young, 3e10}, {K::poisson, 0.2}}, Plane::stress, -1.0)),
              HasSubstr("density -1"));
  // c_bar < 2 c_s, c_s < c_p, c_bar <= c_p; in plane strain c_bar < sqrt(3) c_s and c_s < sqrt(3)/2 c_p.
  EXPECT_THAT(refusal(with({{K::bar, 3000.0}, {K::shear, 1499.0}})), HasSubstr("contradict"));
  EXPECT_EQ(refusal(with({{K::bar, 3000.0}, {K::shear, 1501.0}})), "");
  EXPECT_THAT(refusal(with({{K::p, 3000.0}, {K::shear, 3001.0}})), HasSubstr("contradict"));
  EXPECT_THAT(refusal(with({{K::p, 3000.0}, {K::bar, 3001.0}})), HasSubstr("contradict"));
  EXPECT_THAT(refusal(with({{K::bar, 3000.0}, {K::shear, 1731.0}}, Plane::strain)), HasSubstr("contradict"));
  EXPECT_EQ(refusal(with({{K::bar, 3000.0}, {K::shear, 1733.0}}, Plane::strain)), "");
  EXPECT_THAT(refusal(with({{K::p, 3000.0}, {K::shear, 2599.0}}, Plane::strain)), HasSubstr("contradict"));
}

TEST(ParseUncertain, ReadsUnitsAndUncertainties) {
  const auto is = [](const Uncertain& u, double value, double stddev) {
    return u.value == value && u.stddev == stddev;
  };
  EXPECT_TRUE(is(parse_uncertain("--young", "30 GPa", Dimension::stress), 30e9, 0.0));
  EXPECT_TRUE(is(parse_uncertain("--young", "30e9+-1e9", Dimension::stress), 30e9, 1e9));
  EXPECT_TRUE(is(parse_uncertain("--young", "30 GPa \u00B1 500 MPa", Dimension::stress), 30e9, 500e6));
  EXPECT_TRUE(is(parse_uncertain("--shear-velocity", "2.2 km/s", Dimension::velocity), 2200.0, 0.0));
  EXPECT_TRUE(is(parse_uncertain("--poisson", "0.25 +- 0.01", Dimension::none), 0.25, 0.01));
  for (const char* bad : {"30 +- 1 GPa", "30 GPa +- 1", "30 kg", "thirty", "", "30 GPa +-", "+- 1 GPa",
                          "30 GPa +- 1 GPa +- 1 GPa"}) {
    EXPECT_THROW(parse_uncertain("--young", bad, Dimension::stress), InputError) << bad;
  }
}

}  // namespace
}  // namespace ddem::harness
