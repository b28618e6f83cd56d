#ifndef nmm_fracture_fracture_h
#define nmm_fracture_fracture_h

#include <nmm/fracture/crack_start.h>
#include <nmm/fracture/energy_release_criterion.h>
#include <nmm/fracture/growth_criterion.h>
#include <nmm/fracture/hoop_stress_criterion.h>
#include <nmm/fracture/intensity_factors.h>
#include <nmm/fracture/kink_factors.h>
#include <nmm/fracture/local_symmetry_criterion.h>
#include <nmm/fracture/tip_cover.h>
#include <nmm/fracture/tip_field.h>
#include <nmm/fracture/tip_grading.h>

/**
 * @defgroup fracture Fracture
 *
 * Intensity factors of crack tips, and the directions in which cracks grow. This room knows covers,
 * materials and displacement fields; it solves no system itself.
 *
 * **In**: the tips of a physical mesh (find_crack_tips()) and a DisplacementField.
 * **Out**: IntensityFactors of each tip, and the direction in which it grows.
 *
 * | file | job |
 * |---|---|
 * | nmm/covers/crack_tip.h | the tips, their frames, and the angle that jumps on the crack |
 * | nmm/geometry/crack_extension.h | the extension of a crack, up to the first curve it meets |
 * | crack_start.h | places at boundaries where cracks may start |
 * | tip_grading.h | grading of cells towards a tip |
 * | tip_cover.h | covers with the functions that are singular at a tip |
 * | tip_field.h | elastic fields about a tip |
 * | intensity_factors.h | interaction integrals |
 * | growth_criterion.h | the interface of growth criteria, and their list; each has its own file |
 * | kink_factors.h | intensity factors of a short kink |
 *
 * Order of calls:
 * @code
 * const PhysicalMesh physical_mesh(geometry);
 * const std::vector<CrackTip> tips = find_crack_tips(physical_mesh);
 * GradedMeshParameters mesh;                        // with its cell size
 * mesh.local_sizes = sizes_at_tips(physical_mesh, 0.25);
 * // ... covers, StaticElasticity, DisplacementField field ...
 * for (const CrackTip &tip : tips)
 *   {
 *     const IntensityFactors k = compute_intensity_factors(field, problem, tip);
 *     const auto verdict = HoopStressCriterion().judge(k.K_I, k.K_II);
 *     if (verdict.equivalent_intensity > toughness)
 *       extend_crack(geometry, tip.point, turned(tip.direction, verdict.angle), length, "crack");
 *   }
 * @endcode
 * To add a criterion, derive from GrowthCriterion in a file of its own and name it in
 * growth_criteria().
 */

#endif
