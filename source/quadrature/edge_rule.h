#ifndef nmm_source_quadrature_edge_rule_h
#define nmm_source_quadrature_edge_rule_h

#include <nmm/quadrature/element_quadrature.h>

namespace NMM
{
  namespace internal
  {
    /// Write the rule of make_edge_rule() to @p rule, whose memory is used again.
    void
    set_edge_rule(const ElementEdge &edge,
                  const CellFrame   &frame,
                  unsigned int       degree,
                  EdgeRule          &rule);
  } // namespace internal
} // namespace NMM

#endif
