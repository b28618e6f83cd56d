#ifndef nmm_mechanics_solid_layout_h
#define nmm_mechanics_solid_layout_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/force_term.h>

#include <memory>
#include <vector>

namespace NMM
{
  /// The ModelLayout of a solid. Lifetime: the elasticity must outlive this object.
  class SolidLayout
  {
  public:
    /// @p mass is ModelLayout::mass; null for a solid at rest.
    explicit SolidLayout(
      const FiniteElasticity                  &elasticity,
      std::shared_ptr<const ForceTerm::Matrix> mass = nullptr);
    SolidLayout(const SolidLayout &) = delete;
    SolidLayout &
    operator=(const SolidLayout &) = delete;

    /// The unknowns of the solid.
    const ModelLayout &
    unknowns() const
    {
      return layout;
    }

    /// Set ModelLayout::absent_unknowns to those of the blocks for which @p is_absent is true;
    /// empty: none is.
    void
    set_absent_blocks(const std::vector<bool> &is_absent);

  private:
    void
    set_blocks();

    const CoverSystem                       *covers;
    std::shared_ptr<const ForceTerm::Matrix> mass;
    ForceTerm::Vector                        positions;
    ModelLayout                              layout;
  };
} // namespace NMM

#endif
