#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>
#include <nmm/mechanics/bolt_term.h>

#include <algorithm>
#include <base/hash.h>
#include <cmath>
#include <mechanics/placed_bolt.h>
#include <sstream>

namespace NMM
{
  using internal::PlacedBolt;

  namespace
  {
    /// An error in a value of a bolt.
    void
    check_value(const Bolt        &bolt,
                const bool         is_right,
                const char        *what,
                const double       value,
                const std::string &remedy)
    {
      std::ostringstream text;
      text << "the " << what << " is " << value;
      AssertThrow(is_right,
                  InputError(text.str(), "bolt '" + bolt.name + "'", remedy));
    }


    void
    check_bolt(const Bolt &bolt)
    {
      const bool is_grouted = bolt.type == Bolt::Type::grouted;
      const auto positive   = [&](const char *what, const double value) {
        check_value(bolt,
                    value > 0. && std::isfinite(value),
                    what,
                    value,
                    "give a number above 0");
      };
      const auto limit = [&](const char *what, const double value) {
        check_value(bolt, value > 0., what, value, "give a number above 0");
      };
      const auto not_negative = [&](const char *what, const double value) {
        check_value(bolt,
                    value >= 0. && std::isfinite(value),
                    what,
                    value,
                    "give 0 or a number above it");
      };
      positive("Young's modulus [Pa]", bolt.youngs_modulus);
      positive("area [m^2]", bolt.area);
      positive("spacing [m]", bolt.spacing);
      limit("yield force [N]", bolt.yield_force);
      limit("rupture strain [-]", bolt.rupture_strain);
      limit("bond strength [N/m]", bolt.bond_strength);
      limit("grouted length [m]", bolt.grouted_length);
      not_negative("pretension [N]", bolt.pretension);
      not_negative("dowel stiffness [N/m]", bolt.dowel_stiffness);
      not_negative("bedding stiffness [N/m^2]", bolt.bedding_stiffness);
      if (is_grouted)
        positive("bond stiffness [N/m^2]", bolt.bond_stiffness);
      const std::string where = "bolt '" + bolt.name + "'";
      AssertThrow(is_grouted ||
                    (bolt.bond_stiffness == 0. && bolt.dowel_stiffness == 0. &&
                     bolt.bedding_stiffness == 0.),
                  InputError("bond, dowel or bedding have no effect on a "
                             "bolt that is anchored at its ends only",
                             where,
                             "remove them, or set 'Type = grouted'"));
      AssertThrow(bolt.dowel_stiffness == 0. || bolt.bedding_stiffness == 0.,
                  InputError("dowel and bedding stiffness are both given",
                             where,
                             "give one, the other follows from it"));
      AssertThrow(bolt.pretension == 0. || !is_grouted || bolt.faceplate,
                  InputError("a pretension without a faceplate has nothing "
                             "to press on",
                             where,
                             "set 'Faceplate = true', or remove it"));
    }
  } // namespace

  struct BoltTerm::Data
  {
    std::vector<Bolt>       bolts;
    std::vector<PlacedBolt> placed;
    Kinematics              kinematics;
  };


  BoltTerm::BoltTerm(const CoverSystem &covers,
                     const ModelLayout &layout,
                     std::vector<Bolt>  bolts,
                     const Kinematics   kinematics)
    : data(std::make_unique<Data>())
  {
    data->kinematics = kinematics;
    internal::Hash sum;
    sum.add(kinematics);
    for (const Bolt &bolt : bolts)
    {
      check_bolt(bolt);
      data->placed.emplace_back(covers, layout, bolt, kinematics);
      for (const auto &x : bolt.path)
        for (const double value : {x[0], x[1]})
          sum.add(value);
      for (const double value : {bolt.youngs_modulus,
                                 bolt.area,
                                 bolt.bond_stiffness,
                                 bolt.bond_strength,
                                 bolt.grouted_length,
                                 bolt.yield_force,
                                 bolt.rupture_strain,
                                 bolt.pretension,
                                 bolt.spacing,
                                 bolt.dowel_stiffness,
                                 bolt.bedding_stiffness,
                                 bolt.installed_at})
        sum.add(value);
      sum.add(bolt.type);
      sum.add(bolt.faceplate);
      if (bolt.installed_at > 0.)
        event_times.push_back(bolt.installed_at);
    }
    data->bolts = std::move(bolts);
    hash        = sum.value();
  }


  BoltTerm::~BoltTerm() = default;


  std::vector<BoltTerm::Unknowns>
  BoltTerm::couplings() const
  {
    std::vector<Unknowns> result;
    for (const PlacedBolt &bolt : data->placed)
      result.push_back(bolt.unknowns());
    return result;
  }


  void
  BoltTerm::begin_step(const StepBegin &step)
  {
    for (PlacedBolt &bolt : data->placed)
    {
      bolt.withdraw();
      // rounding of the time
      const double tolerance = 1e-6 * step.length;
      if (!bolt.is_active() &&
          step.time >= bolt.bolt().installed_at - std::abs(tolerance))
        bolt.begin(bolt.displacements(step.u));
    }
  }


  Deformation
  BoltTerm::assemble(const Trial &trial, AssembledForces &sum)
  {
    for (const PlacedBolt &bolt : data->placed)
    {
      if (!bolt.is_active())
        continue;
      const PlacedBolt::Displacements end = bolt.displacements(*trial.end);
      PlacedBolt::Displacements       begin;
      if (trial.is_conserving)
        begin = bolt.displacements(*trial.begin);
      const PlacedBolt::Forces forces =
        bolt.assemble(end,
                      trial.is_conserving ? &begin : nullptr,
                      trial.tangent != Tangent::none);
      if (!forces.is_found)
        return Deformation::inverted;
      sum.sink->add(bolt.unknowns(), forces.forces, forces.tangent);
      sum.energy_of_conditions += forces.energy;
    }
    return Deformation::admissible;
  }


  ForceProperties
  BoltTerm::properties() const
  {
    return {/* is_linear = */ false,
            /* is_symmetric = */ true,
            /* is_symmetric_between = */ data->kinematics == Kinematics::small};
  }


  StepWork
  BoltTerm::commit(const Trial &step)
  {
    StepWork sum;
    for (PlacedBolt &bolt : data->placed)
    {
      if (!bolt.is_active())
        continue;
      PlacedBolt::Displacements begin;
      if (step.is_conserving)
        begin = bolt.displacements(*step.begin);
      const StepWork work = bolt.commit(bolt.displacements(*step.end),
                                        step.is_conserving ? &begin : nullptr);
      sum.supports += work.supports;
      sum.dissipated += work.dissipated;
    }
    return sum;
  }


  void
  BoltTerm::set_presence(const Presence &presence)
  {
    for (PlacedBolt &bolt : data->placed)
      bolt.set_presence(presence.absent_blocks);
  }


  void
  BoltTerm::forget()
  {
    for (PlacedBolt &bolt : data->placed)
      bolt.forget();
  }


  void
  BoltTerm::save(ByteWriter &archive) const
  {
    for (PlacedBolt &bolt : data->placed)
      bolt.serialize(archive, 0);
  }


  void
  BoltTerm::restore(ByteReader &archive)
  {
    for (PlacedBolt &bolt : data->placed)
    {
      bolt.serialize(archive, 0);
      require_in_checkpoint(bolt.is_consistent(),
                            "the state of the bolt '" + bolt.bolt().name +
                              "' does not fit");
    }
  }


  const std::vector<Bolt> &
  BoltTerm::bolts() const
  {
    return data->bolts;
  }


  std::vector<BoltReport>
  BoltTerm::reports(const Vector &u) const
  {
    std::vector<BoltReport> result;
    for (const PlacedBolt &bolt : data->placed)
      result.push_back(bolt.report(bolt.displacements(u)));
    return result;
  }
} // namespace NMM
