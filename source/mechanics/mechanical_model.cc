#include <nmm/base/archive.h>
#include <nmm/mechanics/mechanical_model.h>

#include <algorithm>
#include <cmath>
#include <mechanics/coupled_forces.h>
#include <utility>

namespace NMM
{
  MechanicalModel::MechanicalModel(const ModelLayout       &layout,
                                   std::vector<ForceTerm *> terms_in)
    : unknowns(&layout)
    , terms(std::move(terms_in))
  {
    std::vector<ForceTerm::Unknowns> couplings;
    for (const ForceTerm *term : terms)
      for (ForceTerm::Unknowns &unknowns : term->couplings())
        couplings.push_back(std::move(unknowns));
    if (!couplings.empty())
      coupled =
        std::make_unique<internal::CoupledForces>(layout, std::move(couplings));
    for (ForceTerm *term : terms)
      term->set_presence(presence);
  }


  MechanicalModel::~MechanicalModel() = default;


  void
  MechanicalModel::begin_step(const StepBegin &step)
  {
    for (ForceTerm *term : terms)
      term->begin_step(step);
  }


  Deformation
  MechanicalModel::assemble(const Trial &trial)
  {
    if (trial.tangent != Tangent::none)
      sum = AssembledForces();
    sum.scale = sum.rounding = sum.strain_energy = sum.energy_of_conditions =
      0.;
    sum.damping.clear();
    if (coupled)
      coupled->begin(trial, sum);
    for (ForceTerm *term : terms)
      if (term->assemble(trial, sum) != Deformation::admissible)
        return Deformation::inverted;
    if (coupled)
      coupled->finish(sum);
    return Deformation::admissible;
  }


  ForceProperties
  MechanicalModel::properties() const
  {
    ForceProperties all;
    for (const ForceTerm *term : terms)
    {
      const ForceProperties one = term->properties();
      all.is_linear             = all.is_linear && one.is_linear;
      all.is_symmetric          = all.is_symmetric && one.is_symmetric;
      all.is_symmetric_between =
        all.is_symmetric_between && one.is_symmetric_between;
    }
    return all;
  }


  StepFault
  MechanicalModel::find_fault(const Vector &end)
  {
    StepFault fault;
    for (ForceTerm *term : terms)
      if (fault.reason.empty())
        fault = term->find_fault(end);
    return fault;
  }


  std::vector<bool>
  MechanicalModel::pressed_blocks() const
  {
    std::vector<bool> pressed;
    for (const ForceTerm *term : terms)
    {
      const std::vector<bool> of_term = term->pressed_blocks();
      pressed.resize(std::max(pressed.size(), of_term.size()), false);
      for (unsigned int b = 0; b < of_term.size(); ++b)
        pressed[b] = pressed[b] || of_term[b];
    }
    return pressed;
  }


  void
  MechanicalModel::forget()
  {
    for (ForceTerm *term : terms)
      term->forget();
  }


  StepWork
  MechanicalModel::commit(const Trial &step)
  {
    StepWork work;
    for (ForceTerm *term : terms)
    {
      const StepWork of_term = term->commit(step);
      work.loads += of_term.loads;
      work.supports += of_term.supports;
      work.dissipated += of_term.dissipated;
    }
    return work;
  }


  void
  MechanicalModel::pass_events(const double t)
  {
    presence.events_passed = t;
    for (ForceTerm *term : terms)
      term->set_presence(presence);
  }


  void
  MechanicalModel::set_absent_blocks(const std::vector<bool> &is_absent)
  {
    presence.absent_blocks = is_absent;
    for (ForceTerm *term : terms)
      term->set_presence(presence);
  }


  std::vector<double>
  MechanicalModel::events() const
  {
    std::vector<double> times;
    for (const ForceTerm *term : terms)
      times.insert(times.end(), term->events().begin(), term->events().end());
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
  }


  std::uint64_t
  MechanicalModel::fingerprint() const
  {
    std::uint64_t hash = 0;
    for (const ForceTerm *term : terms)
      hash += term->fingerprint();
    return hash;
  }


  /// The bytes of each term are followed by those of all terms before it, as a list.
  std::vector<char>
  MechanicalModel::internal_state() const
  {
    std::vector<char> state;
    for (const ForceTerm *term : terms)
    {
      ByteWriter archive;
      term->save(archive);
      if (term != terms.front())
        archive &state;
      state = std::move(archive.written);
    }
    return state;
  }


  void
  MechanicalModel::restore_internal_state(std::vector<char> state)
  {
    for (auto term = terms.rbegin(); term != terms.rend(); ++term)
    {
      ByteReader        archive(state);
      std::vector<char> of_terms_before;
      (*term)->restore(archive);
      if (*term != terms.front())
        archive &of_terms_before;
      ByteReader::require(archive.n_left() == 0);
      state = std::move(of_terms_before);
    }
  }
} // namespace NMM
