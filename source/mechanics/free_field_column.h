#ifndef nmm_source_mechanics_free_field_column_h
#define nmm_source_mechanics_free_field_column_h

#include <nmm/mechanics/loading.h>

#include <deal.II/base/tensor.h>

#include <Eigen/SparseCholesky>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * A column of elastic ground along y of which only y-dependent motion remains, w(y, t) in x by
     * shear and in y by compression:
     * @f[ \rho\ddot w_c = (E_c w_c')', \qquad E_x = \mu,\ E_y = \lambda + 2\mu. @f]
     * The top is free. The base has dashpots of (rho E_c)^(1/2), and an incoming wave whose
     * traction is doubled, as AbsorbingTerm has it. Both components are solved by quadratic
     * elements and the trapezoidal rule, which is of order 2 and keeps the energy.
     */
    class FreeFieldColumn
    {
    public:
      /// A layer from @p y_0 to @p y_1 [m]: density [kg/m^3] and Lame's constants of the plane
      /// [Pa].
      struct Layer
      {
        double y_0, y_1, density, lambda, mu;
      };

      /// The motion: nodal displacements and velocities of the components x and y. Accelerations
      /// are those of the forces at the time.
      struct State
      {
        std::vector<double> w[2], v[2];

        template <typename Archive>
        void
        serialize(Archive &archive, const unsigned int /*version*/)
        {
          for (unsigned int c = 0; c < 2; ++c)
            archive &w[c] & v[c];
        }
      };

      /// @p layers in any order. @throws InputError naming @p where for layers with gaps between
      /// them.
      FreeFieldColumn(std::vector<Layer>     layers,
                      const RayleighDamping &damping,
                      const std::string     &where);

      /// Number of nodes, from the base upwards: ends and middles of layers.
      unsigned int
      n_nodes() const
      {
        return 2 * layers.size() + 1;
      }

      /// The dashpots of the base (rho E_c)^(1/2) [Pa s/m].
      double
      impedance(unsigned int c) const;

      /// Try a step of the length @p h [s] from the state, with the tractions at the base @p begin
      /// and @p end [Pa], in which the factor 2 is contained.
      void
      try_step(double                       h,
               const std::array<double, 2> &begin,
               const std::array<double, 2> &end);

      /// The motion at a place and time.
      struct Motion
      {
        /// Velocity [m/s], and derivative of the displacement by y [-].
        dealii::Tensor<1, 2> velocity, strain;
      };

      /// That at @p y [m], at the @p share of the step that was tried.
      Motion
      at(double y, double share) const;

      /// Accept the step.
      void
      accept()
      {
        state = tried;
      }

      State state, tried;

    private:
      using Matrix = Eigen::SparseMatrix<double>;
      using Solver = Eigen::SimplicialLDLT<Matrix>;

      void
      make_matrices(const RayleighDamping &damping);

      std::vector<Layer> layers;
      Matrix             mass, stiffness[2], damping[2];
      /// Factors of the mass, and of the matrices of a step of the length `factorized_step` [s].
      std::unique_ptr<Solver> mass_solver, step_solvers[2];
      double                  factorized_step = 0.;
    };
  } // namespace internal
} // namespace NMM

#endif
