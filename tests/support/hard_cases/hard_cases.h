#ifndef nmm_tests_support_hard_cases_hard_cases_h
#define nmm_tests_support_hard_cases_hard_cases_h

#include <nmm/covers/aggregation.h>

#include <mechanics/model.h>
#include <string>
#include <vector>

namespace NMM
{
  /**
   * The cases that cut methods are known to suffer from. Every function builds
   * and solves one of them and returns what it measured; the program
   * nmm-hard-cases prints them all, the tests assert bounds at a smaller size.
   */
  namespace HardCases
  {
    using namespace Test;

    /// One solved system.
    struct Result
    {
      std::string   variant;
      Stabilization stabilization = Stabilization::aggregation;
      unsigned int  n_unknowns    = 0;
      /// Smallest area of an element over that of its cell [-].
      double smallest_fraction = 1.;
      /// Condition numbers after diagonal scaling [-], 0 if not asked for.
      double stiffness_condition = 0., mass_condition = 0.;
      /// Conjugate gradients with ML to 1e-10, 0 if not asked for.
      unsigned int cg_iterations = 0;
      /// Relative errors in L2 and in the energy norm [-].
      double displacement_error = 0., energy_error = 0.;
      /// Why there are no numbers; empty if there are.
      std::string failure;
    };

    /// What is asked for besides the errors.
    struct Measure
    {
      bool condition     = true;
      bool cg_iterations = false;
    };

    /// A smooth displacement with what follows from it.
    class SmoothField
    {
    public:
      virtual ~SmoothField() = default;
      virtual Tensor<1, 2>
      displacement(const Point<2> &x) const = 0;
      virtual Tensor<2, 2>
      gradient(const Point<2> &x) const = 0;
      /// f = -div sigma.
      virtual Tensor<1, 2>
      body_force(const Point<2> &x, const PlaneElasticity &e) const = 0;
    };

    /// u_c = a_c sin(k_c . x + phi_c).
    std::shared_ptr<const SmoothField>
    make_wave_field();

    /// Free of traction on the line through @p origin along @p tangent (unit):
    /// u = eta^2 (t sin(2 xi) + n cos(2 xi)), eta the distance from it.
    std::shared_ptr<const SmoothField>
    make_free_surface_field(const Point<2>     &origin,
                            const Tensor<1, 2> &tangent);

    /// A random polynomial of @p degree about @p center: exact on any cut.
    std::shared_ptr<const SmoothField>
    make_polynomial_field(unsigned int    seed,
                          unsigned int    degree,
                          const Point<2> &center = Point<2>());

    /// Without divergence: u = sum_m d_m sin(k_m . x + phi_m), d_m normal to k_m.
    std::shared_ptr<const SmoothField>
    make_solenoidal_field();

    /**
     * A cantilever of depth 1, 0 < x < @p length, -1/2 < y < 1/2, under a
     * parabolic shear load at its end, plane stress: stresses sigma_x = P (L -
     * x) y / I, tau = -P (1/4 - y^2) / (2 I), a cubic displacement (Timoshenko
     * & Goodier, art. 21); P such that the end sinks by 1.
     */
    std::shared_ptr<const SmoothField>
    make_beam_field(double length, const Material &material);

    /// Make @p model's problem have the solution @p field: body force,
    /// displacements on @p held, tractions on @p loaded curves. One material.
    void
    prescribe(Model                                    &model,
              const std::shared_ptr<const SmoothField> &field,
              const Material                           &material,
              PlaneState                                plane_state,
              const std::vector<std::string>           &held,
              const std::vector<std::string>           &loaded);

    /// Solve and measure against @p field.
    Result
    measure(Model             &model,
            const SmoothField &field,
            const std::string &variant,
            Stabilization      stabilization,
            const Measure     &what);

    /// How the cut side of the sliver sweep is held.
    enum class Side
    {
      free,
      loaded,
      fixed
    };

    const std::string &
    to_string(Side side);

    const std::string &
    to_string(Stabilization stabilization);

    /**
     * Case 1: the unit square on a mesh of right-angled triangles that fits it
     * but for the upper side, which lies epsilon h above a mesh line at its
     * left end and rises by @p angle [degrees] to the right. epsilon = angle =
     * 0 is the uncut mesh. @p polynomial_degree > 0: patch test.
     */
    Result
    sliver(double         epsilon,
           double         angle,
           Side           side,
           Stabilization  stabilization,
           unsigned int   n_cells_per_side,
           unsigned int   polynomial_degree,
           const Measure &what);

    /// The unit disk, its halves called left and right.
    Geometry
    make_disk();

    /// Case 2: the unit disk at a random place (seeded) on a mesh of
    /// equilateral triangles, its left half held, its right half loaded.
    Result
    moved_disk(unsigned int   seed,
               double         cell_size,
               Stabilization  stabilization,
               unsigned int   polynomial_degree,
               const Measure &what);

    /// The uncut companion of the disk: the hexagon of about equal area on the
    /// lattice of the same triangles, its left half held, its right half
    /// loaded; with the wave field, or the solenoidal one.
    Result
    fitted_hexagon(double         cell_size,
                   const Measure &what,
                   double         poissons_ratio = 0.3,
                   bool           solenoidal     = false);

    /**
     * Case 3: a column of depth 1 between smooth walls under its own weight and
     * a pressure, with a layer of @p thickness h between two closed joints whose
     * stiffness is @p contrast times that of the rest. Quadratic in each layer,
     * hence exact.
     */
    Result
    thin_layer(double         thickness,
               double         contrast,
               Stabilization  stabilization,
               const Measure &what);

    /// Case 3: two closed joints that cross at 1 degree. Quadratic patch test.
    Result
    sharp_wedges(double         cell_size,
                 Stabilization  stabilization,
                 const Measure &what);

    /// A square, a triangle or a disk of @p size h.
    enum class Shape
    {
      square,
      triangle,
      disk
    };

    const std::string &
    to_string(Shape shape);

    /**
     * Case 5: a block of @p size h, turned by 20 degrees, alone (held on its
     * boundary, or on a side and loaded on the others) or tied into a frame
     * whose boundary is held. Linear patch test about the block's centre: a
     * random constant stress, or a rigid rotation, for which the energy
     * error is absolute, over that of a unit strain.
     */
    Result
    small_block(Shape          shape,
                double         size,
                bool           in_frame,
                bool           rigid,
                Stabilization  stabilization,
                const Measure &what);

    /// Where a joint meets the mesh.
    enum class Track
    {
      along_mesh_lines,
      along_diagonals,
      through_nodes
    };

    const std::string &
    to_string(Track track);

    struct Coincidence
    {
      unsigned int                       n_elements = 0;
      std::vector<Tensor<1, 2>>          displacements;
      std::vector<SymmetricTensor<2, 2>> stresses;
    };

    /// Case 4: the unit square with a joint on @p track, moved upwards by @p
    /// n_ulp floating point numbers; displacements and stresses at 81 places.
    Coincidence
    joint_on_mesh(Track         track,
                  JointState    state,
                  unsigned int  n_ulp,
                  Stabilization stabilization);

    /// Largest difference of displacements and stresses over their largest
    /// value [-].
    double
    difference(const Coincidence &a, const Coincidence &b);

    /// Case 6: the disk with a divergence-free displacement in plane strain.
    Result
    nearly_incompressible(double         poissons_ratio,
                          double         cell_size,
                          Stabilization  stabilization,
                          const Measure &what);

    /// Case 6: a cantilever of depth 1.
    Result
    slender_beam(double         length,
                 double         cell_size,
                 Stabilization  stabilization,
                 const Measure &what);

    /**
     * A unit disk with a concentric inclusion of radius 1/2 whose stiffness is
     * @p contrast times that of the rest, bonded, its rim displaced
     * radially by 1 (right half) or loaded to that effect (left half): u_r = A r
     * inside, B r + C / r outside. Strains jump at the interface, which runs
     * through cells.
     */
    Result
    bonded_inclusion(double         contrast,
                     double         cell_size,
                     Stabilization  stabilization,
                     const Measure &what);

    struct Network
    {
      unsigned int seed = 0, n_regions = 0, n_elements = 0;
      /// |sum of element areas - 1|.
      double area_error = 0.;
      Result solved;
      /// On regions with meshes of their own.
      std::vector<std::string> notices;
    };

    /**
     * Case 7: the unit square with up to @p n_joints_max closed joints and
     * interfaces whose ends lie on a grid of 33 x 33 points, as do the nodes of
     * the mesh (cells of 4 x 4): crossings in nodes, joints along edges and
     * along each other abound. Quadratic patch test.
     */
    Network
    random_network(unsigned int  seed,
                   unsigned int  n_joints_max,
                   Stabilization stabilization);

    /// What aggregation costs on the quarter ring.
    struct Cost
    {
      unsigned int n_unknowns = 0, n_fitted_unknowns = 0;
      /// Finding roots and making constraints; sparsity pattern, assembly and
      /// hand-over to Trilinos [s].
      double aggregation_seconds = 0., assembly_seconds = 0.;
      /// Conjugate gradients with ML to 1e-11: mesh that does not fit with
      /// aggregation and with ghost penalty, and a fitted polar mesh.
      unsigned int cg_iterations = 0, ghost_cg_iterations = 0,
                   fitted_cg_iterations = 0;
    };

    Cost
    cost_on_ring(double cell_size);
  } // namespace HardCases
} // namespace NMM

#endif
