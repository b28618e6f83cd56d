#ifndef nmm_source_mechanics_solid_hash_h
#define nmm_source_mechanics_solid_hash_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <base/hash.h>

namespace NMM
{
  namespace internal
  {
    /// The hash of elements, covers and materials, by which checkpoints recognize a discretized
    /// solid.
    Hash
    hash_of_solid(const CoverSystem &covers, const ElasticityProblem &problem);
  } // namespace internal
} // namespace NMM

#endif
