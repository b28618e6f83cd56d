#include <nmm/base/exceptions.h>
#include <nmm/dynamics/incremental_dynamics.h>
#include <nmm/mechanics/mass_matrix.h>

#include <deal.II/base/mpi.h>

#include <mechanics/matrix_sum.h>
#include <mechanics/mumps_solver.h>

namespace NMM
{
  struct IncrementalDynamics::Data
  {
    IncrementalElasticity                   *elasticity;
    const CoverSystem                       *covers;
    const dealii::AffineConstraints<double> *constraints;
    dealii::TrilinosWrappers::SparseMatrix   mass;
    internal::MatrixSum                      matrix;
    internal::DirectSolver                   solver;
    Vector                                   velocity, momentum, rhs;
  };


  IncrementalDynamics::IncrementalDynamics(
    IncrementalElasticity                   &elasticity,
    const CoverSystem                       &covers,
    const QuadratureCollection              &mass_quadrature,
    const dealii::AffineConstraints<double> &constraints,
    const ElasticityProblem                 &problem)
    : data(std::make_unique<Data>())
  {
    for (const Material &material : problem.materials)
      AssertThrow(material.density > 0.,
                  InputError("The density is " +
                               std::to_string(material.density),
                             "material '" + material.name + "'",
                             "dynamics needs a density above 0"));
    data->elasticity  = &elasticity;
    data->covers      = &covers;
    data->constraints = &constraints;
    assemble_mass_matrix(covers,
                         mass_quadrature,
                         constraints,
                         problem,
                         /* ghost_penalty = */ nullptr,
                         data->mass);
    for (Vector *vector : {&data->velocity, &data->momentum, &data->rhs})
      vector->reinit(covers.locally_owned_dofs(2), covers.communicator());
  }


  IncrementalDynamics::~IncrementalDynamics() = default;


  void
  IncrementalDynamics::set_velocity(const Vector &velocity)
  {
    data->velocity = velocity;
    data->constraints->distribute(data->velocity);
    data->mass.vmult(data->momentum, data->velocity);
    data->constraints->set_zero(data->momentum);
  }


  double
  IncrementalDynamics::step(const double h, const double load_factor)
  {
    Data &d = *data;
    AssertThrow(h > 0.,
                InputError("The time step is " + std::to_string(h) + " s",
                           "step-by-step dynamics",
                           "choose it above 0"));
    Vector       next(d.velocity);
    const double largest = d.elasticity->step(
      load_factor,
      [&](const IncrementalElasticity::Matrix &stiffness,
          const Vector                        &residual,
          Vector                              &correction) {
        d.matrix.assemble(stiffness, 1., d.mass, 2. / (h * h), nullptr, 0.);
        d.solver.factorize(d.matrix());
        d.rhs = residual;
        d.rhs.add(-2. / h, d.momentum);
        d.solver.solve(d.rhs, correction);
        // v = 2 du / h - v, du = -correction
        next.sadd(-1., -2. / h, correction);
      });
    set_velocity(next);
    return largest;
  }


  const IncrementalDynamics::Vector &
  IncrementalDynamics::velocity() const
  {
    return data->velocity;
  }


  double
  IncrementalDynamics::kinetic_energy() const
  {
    return 0.5 * (data->momentum * data->velocity);
  }


  double
  IncrementalDynamics::angular_momentum() const
  {
    const Vector &u   = data->elasticity->solution();
    double        sum = 0.;
    for (const auto k : data->covers->locally_owned_covers())
    {
      const dealii::Point<2> &x = data->covers->node(k);
      sum += (x[0] + u(2 * k)) * data->momentum(2 * k + 1) -
             (x[1] + u(2 * k + 1)) * data->momentum(2 * k);
    }
    return dealii::Utilities::MPI::sum(sum, data->covers->communicator());
  }
} // namespace NMM
