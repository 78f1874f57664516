// SPDX-License-Identifier: Apache-2.0
// Blood flows through a duct with a heart valve. This program uses riis in deal.II, with Taylor-Hood elements on an adaptive
// mesh, on any number of ranks. Each time step solves one linear system for the velocity u and the pressure p:
//
//   rho (u - u_old) / dt + rho (u_old . grad) u - mu laplace(u) + grad(p) + K u = K u_valve,   div(u) = 0
//
// riis gives K and K u_valve at the quadrature points (obstacle.hpp). riis also gives distances, by which the mesh follows the
// valve.
//
//   mpirun -n 2 valve_flow beat.prm [MORE.prm...]          later files overwrite the entries of earlier ones
#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/function_parser.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/petsc_block_sparse_matrix.h>
#include <deal.II/lac/petsc_precondition.h>
#include <deal.II/lac/petsc_vector.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/vector_tools.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>

#include "obstacle.hpp"

using namespace dealii;
namespace PETSc = PETScWrappers::MPI;

// ---- Parameters ------------------------------------------------------------------------------------------------------------

struct Parameters {
  std::string shape = "round";
  double radius = 0.0125, length = 0.06, distortion = 0;
  unsigned int cells_along = 7, cells_across = 1, refinements = 1, refinements_at_valve = 1;

  double density = 1060, viscosity = 0.0035;

  ObstacleSettings obstacle;
  std::string law = "constant";
  double opening = 0, opening_seconds = 0.04, closing_seconds = 0.04, dwell_seconds = 0.02;

  std::string inlet = "pressure", inlet_pressure = "0";
  double inlet_speed = 0;

  double time_step = 0.01, tolerance = 1e-9, grad_div = 3;
  unsigned int n_steps = 1, save_after = 0, pictures_every = 0, max_iterations = 1000;
  std::string restart, folder = ".";

  FunctionParser<1> pressure_at_inlet;  // over the time t

  void read(const std::vector<std::string> &files);

 private:
  void declare(ParameterHandler &prm);
};

void Parameters::declare(ParameterHandler &prm) {
  const Patterns::Double positive(1e-12, 1e12), any(-1e12, 1e12);
  prm.enter_subsection("Duct");  // along the x axis, from 0 to its length
  prm.add_parameter("Shape", shape, "round, with walls at rest, or square, with walls that slip",
                    Patterns::Selection("round|square"));
  prm.add_parameter("Radius", radius, "[m] of the round duct; half the side of the square one", positive);
  prm.add_parameter("Length", length, "[m]", positive);
  prm.add_parameter("Cells along", cells_along, "of the coarse mesh", Patterns::Integer(1, 1000));
  prm.add_parameter("Cells across", cells_across, "of the coarse mesh, square only", Patterns::Integer(1, 100));
  prm.add_parameter("Distortion", distortion, "moves inner nodes at random, by this share of an edge",
                    Patterns::Double(0, 0.4));
  prm.add_parameter("Refinements", refinements, "of all cells", Patterns::Integer(0, 6));
  prm.add_parameter("Refinements at the valve", refinements_at_valve, "in addition", Patterns::Integer(0, 6));
  prm.leave_subsection();
  prm.enter_subsection("Fluid");
  prm.add_parameter("Density", density, "[kg/m3]", positive);
  prm.add_parameter("Viscosity", viscosity, "[Pa s]", Patterns::Double(0, 1e12));
  prm.leave_subsection();
  prm.enter_subsection("Valve");
  prm.add_parameter("Kind", obstacle.kind, "a kind of riis, or plate");
  prm.add_parameter("Parameters", obstacle.parameters, "NAME=VALUE, ... of the kind, in the valve's own unit");
  prm.add_parameter("Scale", obstacle.scale, "[m] the valve's own unit", positive);
  prm.add_parameter("Position", obstacle.position, "[m] of the valve's origin along the duct", any);
  prm.add_parameter("Speed", obstacle.speed, "[m/s] of a plate along the duct", any);
  prm.add_parameter("Half thickness", obstacle.half_thickness, "[m] eps", positive);
  prm.add_parameter("Resistance", obstacle.R, "[kg/(m s)] R", Patterns::Double(0, 1e12));
  prm.add_parameter("Law", law, "constant, or switch: opens by pressure, closes by flow",
                    Patterns::Selection("constant|switch"));
  prm.add_parameter("Opening", opening, "of the law constant: 0 closed to 1 open", Patterns::Double(0, 1));
  prm.add_parameter("Opening seconds", opening_seconds, "from closed to open", positive);
  prm.add_parameter("Closing seconds", closing_seconds, "from open to closed", positive);
  prm.add_parameter("Dwell seconds", dwell_seconds, "the least time between two changes", Patterns::Double(0, 1e12));
  prm.leave_subsection();
  prm.enter_subsection("Inlet");
  prm.add_parameter("Type", inlet, "what is given", Patterns::Selection("pressure|speed"));
  prm.add_parameter("Pressure", inlet_pressure, "[Pa] a function of the time t in seconds; the outlet has 0");
  prm.add_parameter("Speed", inlet_speed, "[m/s]", any);
  prm.leave_subsection();
  prm.enter_subsection("Run");
  prm.add_parameter("Time step", time_step, "[s]", positive);
  prm.add_parameter("Steps", n_steps, "the number of the last step", Patterns::Integer(1, 1000000));
  prm.add_parameter("Grad-div", grad_div, "factor of K h^2 in the grad-div term", Patterns::Double(0, 1e6));
  prm.add_parameter("Tolerance", tolerance, "of the linear system, relative", Patterns::Double(1e-14, 0.1));
  prm.add_parameter("Iterations", max_iterations, "at most, of the linear system", Patterns::Integer(1, 100000));
  prm.add_parameter("Folder", folder, "where results go");
  prm.add_parameter("Pictures every", pictures_every, "steps, for ParaView; 0: none", Patterns::Integer(0, 1000000));
  prm.add_parameter("Save after", save_after, "this step, in the folder; 0: never", Patterns::Integer(0, 1000000));
  prm.add_parameter("Restart from", restart, "a folder with a saved state; empty: start at rest");
  prm.leave_subsection();
}

void Parameters::read(const std::vector<std::string> &files) {
  ParameterHandler prm;
  declare(prm);
  for (const std::string &file : files) {
    AssertThrow(std::filesystem::is_regular_file(file), ExcMessage("there is no parameter file '" + file + "'"));
    prm.parse_input(file);
  }
  const auto require = [](bool holds, const std::string &text) { AssertThrow(holds, ExcMessage(text)); };
  require(obstacle.kind == "plate" ? shape == "square" && obstacle.parameters.empty() : obstacle.speed == 0,
          "Valve/Kind: a plate needs the square duct and no Parameters, and only a plate has a Speed");
  require(law == "constant" || inlet == "pressure", "Valve/Law: the law switch needs the Inlet/Type pressure");
  require(save_after <= n_steps, "Run/Save after is " + std::to_string(save_after) + ", beyond the last step");
  require(std::filesystem::is_directory(folder), "Run/Folder: there is no folder '" + folder + "'");
  try {
    pressure_at_inlet.initialize("t", inlet_pressure, {{"pi", numbers::PI}});
    require(std::isfinite(pressure_at_inlet.value(Point<1>(0.))), "it is not finite at t = 0");
  } catch (const std::exception &) {
    require(false, "Inlet/Pressure: '" + inlet_pressure + "' is not a function of t");
  }
}

// ---- The preconditioner of the linear system --------------------------------------------------------------------------------

// The system is (A B^T; B 0). A good preconditioner is (A B^T; 0 -S) with the Schur complement S = B A^-1 B^T. A is nearly a mass
// matrix, because a velocity has the inertia rho/dt and the resistance K, and both are much larger than the viscosity. So the
// Schur complement S is close to B D^-1 B^T, with the lumped mass matrix D. The matrix B D^-1 B^T is a Laplacian of the pressure
// with the coefficient 1/(rho/dt + K). B gives it the boundary conditions of the flow. D has a separate K for each velocity. With
// one K for a whole cell, a cell partly in the band would also resist flow along the band. Where viscosity and grad-div dominate,
// S is close to the pressure's mass matrix divided by their coefficients. The preconditioner uses the sum of both inverses
// (Cahouet, Chabard 1988).
//
// MUMPS factorises A. In the band the grad-div term is larger than all other terms of A, and it couples the components of the
// velocity. An incomplete LU or SOR therefore does not converge there.
class Preconditioner {
 public:
  Preconditioner(const PETSc::BlockSparseMatrix &system, const PETSc::Vector &diagonal, const PETSc::SparseMatrix &mass)
      : system(system), inverse_of_A(system.block(0, 0)) {
    PETSc::Vector inverse(diagonal);
    const double lumped =
        0.8 * 0.8 * 0.8;  // quadratic elements: the diagonal over the sum of a row, in each direction 0.8
    for (const auto i : diagonal.locally_owned_elements()) inverse(i) = lumped / diagonal(i);
    inverse.compress(VectorOperation::insert);
    system.block(1, 0).mmult(schur, system.block(0, 1), inverse);
    schur.add(1, system.block(1, 1));  // the constrained pressures, which have a diagonal here and no other entry
    PETScWrappers::PreconditionBoomerAMG::AdditionalData data;
    data.symmetric_operator = true;
    inverse_of_schur.initialize(schur, data);
    inverse_of_mass.initialize(mass);
  }

  void vmult(PETSc::BlockVector &to, const PETSc::BlockVector &from) const {
    PETSc::Vector p(from.block(1)), u(from.block(0));
    inverse_of_schur.vmult(p, from.block(1));
    inverse_of_mass.vmult(to.block(1), from.block(1));
    to.block(1) += p;
    to.block(1) *= -1;
    system.block(0, 1).residual(u, to.block(1), from.block(0));  // u = from - B^T p
    inverse_of_A.vmult(to.block(0), u);
  }

 private:
  const PETSc::BlockSparseMatrix &system;
  PETSc::SparseMatrix schur;
  PETScWrappers::PreconditionLU inverse_of_A;
  PETScWrappers::PreconditionBlockJacobi inverse_of_mass;  // incomplete LU on each rank
  PETScWrappers::PreconditionBoomerAMG inverse_of_schur;
};

// ---- The flow ---------------------------------------------------------------------------------------------------------------

class Flow {
 public:
  explicit Flow(const Parameters &parameters);
  void run();

 private:
  enum Boundary : types::boundary_id { wall, inlet, outlet, side_y, side_z };

  void make_mesh();
  void set_up();
  bool adapt_mesh();
  void assemble(double time);
  void assemble_open_boundary(const DoFHandler<3>::active_cell_iterator &cell, double pressure);
  unsigned int solve();
  void report(unsigned int step, double opening, std::int64_t n_marked, unsigned int iterations);
  void draw(unsigned int step) const;
  void write_cells() const;
  void save(unsigned int step, const riis_opening_switch_state &state);
  unsigned int load(riis_opening_switch_state &state);

  const Parameters &parameters;
  const MPI_Comm comm = MPI_COMM_WORLD;
  const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
  ConditionalOStream out;

  parallel::distributed::Triangulation<3> triangulation;
  const FESystem<3> fe;
  DoFHandler<3> dof_handler;
  const QGauss<3> quadrature;
  const QGauss<2> face_quadrature;
  const FEValuesExtractors::Vector velocity;
  const FEValuesExtractors::Scalar pressure;
  std::array<std::vector<unsigned int>, 4> dof;  // [component][shape function of the component]: number in a cell
  AffineConstraints<double> constraints;
  std::vector<IndexSet> owned, relevant;  // of velocity and pressure

  PETSc::BlockSparseMatrix system_matrix, mass_matrix;
  PETSc::Vector velocity_mass;                   // the diagonal of the velocity's mass matrix with rho/dt + K
  PETSc::BlockVector right_hand_side, solution;  // the solution also has the values at ghosts

  Obstacle obstacle;
  Obstacle::Points points;  // the quadrature points of this rank's cells, cell by cell
  std::vector<double> K;
  std::vector<Tensor<1, 3>> K_u;
  double flow_rate = 0;  // through the outlet, of the last step

  // The unit of the pressure in the linear system, which makes velocities and pressures numbers of similar size.
  double pressure_unit = 1;
  // Scratch memory of the assembly.
  FullMatrix<double> cell_matrix, cell_mass;
  Vector<double> cell_rhs, cell_diagonal;
};

Flow::Flow(const Parameters &parameters)
    : parameters(parameters),
      out(std::cout, rank == 0),
      triangulation(comm, Triangulation<3>::limit_level_difference_at_vertices),
      fe(FE_Q<3>(2), 3, FE_Q<3>(1), 1),
      dof_handler(triangulation),
      quadrature(4),
      face_quadrature(3),
      velocity(0),
      pressure(3),
      obstacle(parameters.obstacle, parameters.radius) {
  for (unsigned int c = 0; c < 4; ++c)
    for (unsigned int a = 0; a < fe.base_element(c / 3).n_dofs_per_cell(); ++a)
      dof[c].push_back(fe.component_to_system_index(c, a));
  cell_matrix.reinit(fe.n_dofs_per_cell(), fe.n_dofs_per_cell());
  cell_rhs.reinit(fe.n_dofs_per_cell());
  cell_diagonal.reinit(dof[0].size());
  cell_mass.reinit(dof[3].size(), dof[3].size());
}

// Makes the coarse mesh, which every rank stores. Only its nodes lie on the round wall. The refinement at the valve keeps the
// faces of the wall flat. On a round wall, new nodes would leave gaps between coarse and fine cells, and blood would leak there.
void Flow::make_mesh() {
  Triangulation<3> coarse;
  const double r = parameters.radius, length = parameters.length;
  if (parameters.shape == "round") {
    GridGenerator::subdivided_cylinder(coarse, parameters.cells_along, r, length / 2);
    GridTools::shift(Point<3>(length / 2, 0, 0), coarse);
    // A cylinder along x through the origin remains the same manifold after this shift.
  } else {
    const unsigned int across = parameters.cells_across;
    GridGenerator::subdivided_hyper_rectangle(coarse, {parameters.cells_along, across, across}, Point<3>(0, -r, -r),
                                              Point<3>(length, r, r));
    for (const auto &face : coarse.active_face_iterators()) {
      if (!face->at_boundary()) continue;
      const Point<3> middle = face->center();
      const double tiny = 1e-9 * length;
      face->set_boundary_id(middle[0] < tiny                 ? inlet
                            : middle[0] > length - tiny      ? outlet
                            : std::abs(middle[1]) > r - tiny ? side_y
                                                             : side_z);
    }
  }
  if (parameters.distortion > 0) GridTools::distort_random(parameters.distortion, coarse);
  coarse.refine_global(parameters.refinements);
  Triangulation<3> flat;
  GridGenerator::flatten_triangulation(coarse, flat);
  flat.reset_all_manifolds();
  triangulation.copy_triangulation(flat);
}

// Numbers the unknowns, and allocates everything that depends on their number.
void Flow::set_up() {
  const std::vector<unsigned int> blocks{0, 0, 0, 1};
  dof_handler.distribute_dofs(fe);
  DoFRenumbering::component_wise(dof_handler, blocks);
  const auto n = DoFTools::count_dofs_per_fe_block(dof_handler, blocks);
  const IndexSet all_owned = dof_handler.locally_owned_dofs();
  const IndexSet all_relevant = DoFTools::extract_locally_relevant_dofs(dof_handler);
  owned = {all_owned.get_view(0, n[0]), all_owned.get_view(n[0], n[0] + n[1])};
  relevant = {all_relevant.get_view(0, n[0]), all_relevant.get_view(n[0], n[0] + n[1])};

  constraints.clear();
  constraints.reinit(all_relevant);
  DoFTools::make_hanging_node_constraints(dof_handler, constraints);
  const auto set_boundary = [&](Boundary id, const ComponentMask &mask, double speed) {
    const Functions::ConstantFunction<3> value(std::vector<double>{speed, 0, 0, 0});
    VectorTools::interpolate_boundary_values(dof_handler, id, value, constraints, mask);
  };
  set_boundary(wall, fe.component_mask(velocity), 0);
  set_boundary(side_y, fe.component_mask(FEValuesExtractors::Scalar(1)), 0);
  set_boundary(side_z, fe.component_mask(FEValuesExtractors::Scalar(2)), 0);
  if (parameters.inlet == "speed") set_boundary(inlet, fe.component_mask(velocity), parameters.inlet_speed);
  constraints.close();

  const auto make_matrix = [&](PETSc::BlockSparseMatrix &matrix, bool is_system) {
    Table<2, DoFTools::Coupling> coupling(4, 4);
    for (unsigned int c = 0; c < 4; ++c)
      for (unsigned int d = 0; d < 4; ++d)
        coupling[c][d] = (c == 3 && d == 3) == is_system ? DoFTools::none : DoFTools::always;
    BlockDynamicSparsityPattern pattern(relevant);
    DoFTools::make_sparsity_pattern(dof_handler, coupling, pattern, constraints, false);
    SparsityTools::distribute_sparsity_pattern(pattern, all_owned, comm, all_relevant);
    matrix.reinit(owned, pattern, comm);
  };
  make_matrix(system_matrix, true);
  make_matrix(mass_matrix, false);
  velocity_mass.reinit(owned[0], comm);
  right_hand_side.reinit(owned, comm);
  solution.reinit(owned, relevant, comm);

  points.clear();
  FEValues<3> fe_values(fe, quadrature, update_quadrature_points);
  for (const auto &cell : dof_handler.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    fe_values.reinit(cell);
    points.insert(points.end(), fe_values.get_quadrature_points().begin(), fe_values.get_quadrature_points().end());
  }
  obstacle.set_points(points);
  K.resize(points.size());
  K_u.resize(points.size());
}

// Refines cells that the band touches, and coarsens other cells. Returns whether any cell was refined. Every point of a cell is
// at most half a diameter from the centre, so the distance of the centre decides. Cells are merged only if the merged cell would
// not be refined again.
bool Flow::adapt_mesh() {
  Obstacle::Points centres;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned()) centres.push_back(cell->center());
  const std::vector<double> distance = obstacle.distances(centres);
  const int finest = parameters.refinements_at_valve;
  std::size_t i = 0;
  for (const auto &cell : triangulation.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    const double gap = distance[i++] - parameters.obstacle.half_thickness, diameter = cell->diameter();
    if (cell->level() < finest && gap < 0.5 * diameter)
      cell->set_refine_flag();
    else if (cell->level() > 0 && gap > 1.6 * diameter)
      cell->set_coarsen_flag();
  }
  triangulation.prepare_coarsening_and_refinement();
  std::vector<unsigned int> flags(2);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned()) flags[0] += cell->refine_flag_set(), flags[1] += cell->coarsen_flag_set();
  Utilities::MPI::sum(flags, comm, flags);
  if (flags[0] + flags[1] == 0) return false;

  parallel::distributed::SolutionTransfer<3, PETSc::BlockVector> transfer(dof_handler);
  transfer.prepare_for_coarsening_and_refinement(solution);
  triangulation.execute_coarsening_and_refinement();
  set_up();
  PETSc::BlockVector moved(owned, comm);
  transfer.interpolate(moved);
  constraints.distribute(moved);
  solution = moved;
  return flags[0] > 0;
}

void Flow::assemble(double time) {
  const double rho = parameters.density, rho_dt = rho / parameters.time_step, mu = parameters.viscosity;
  const double unit = pressure_unit;
  system_matrix = 0;
  mass_matrix = 0;
  velocity_mass = 0;
  right_hand_side = 0;
  FEValues<3> fe_values(fe, quadrature, update_values | update_gradients | update_JxW_values);
  const unsigned int n_q = quadrature.size(), n_u = dof[0].size(), n_p = dof[3].size();
  std::vector<Tensor<1, 3>> u_old(n_q), grad_phi(n_u);
  std::vector<double> div_u_old(n_q), phi(n_u), psi(n_p);
  std::vector<types::global_dof_index> ids(fe.n_dofs_per_cell()), pressure_ids(n_p);

  std::size_t point = 0;
  for (const auto &cell : dof_handler.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    fe_values.reinit(cell);
    fe_values[velocity].get_function_values(solution, u_old);
    fe_values[velocity].get_function_divergences(solution, div_u_old);
    cell_matrix = 0, cell_rhs = 0, cell_mass = 0, cell_diagonal = 0;

    double volume = 0, mean_K = 0;
    for (unsigned int q = 0; q < n_q; ++q) volume += fe_values.JxW(q), mean_K += K[point + q] * fe_values.JxW(q);
    mean_K /= volume;
    // In the band the pressure is steep. A grad-div term limits the effect of the pressure's error on the velocity.
    const double grad_div = parameters.grad_div * mean_K * std::pow(volume, 2. / 3);

    for (unsigned int q = 0; q < n_q; ++q, ++point) {
      const double dx = fe_values.JxW(q), inertia = rho_dt + K[point] + 0.5 * rho * div_u_old[q];
      const Tensor<1, 3> load = rho_dt * u_old[q] + K_u[point];
      for (unsigned int a = 0; a < n_u; ++a)
        phi[a] = fe_values.shape_value(dof[0][a], q), grad_phi[a] = fe_values.shape_grad(dof[0][a], q);
      for (unsigned int a = 0; a < n_p; ++a) psi[a] = fe_values.shape_value(dof[3][a], q);

      for (unsigned int a = 0; a < n_u; ++a) {
        cell_diagonal(a) += dx * (rho_dt + K[point]) * phi[a] * phi[a];
        for (unsigned int b = 0; b < n_u; ++b) {
          const double same =
              dx * (phi[a] * (inertia * phi[b] + rho * (u_old[q] * grad_phi[b])) + mu * (grad_phi[a] * grad_phi[b]));
          for (unsigned int c = 0; c < 3; ++c) cell_matrix(dof[c][a], dof[c][b]) += same;
          if (grad_div > 0)
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                cell_matrix(dof[c][a], dof[d][b]) += dx * grad_div * grad_phi[a][c] * grad_phi[b][d];
        }
        for (unsigned int c = 0; c < 3; ++c) {
          cell_rhs(dof[c][a]) += dx * load[c] * phi[a];
          for (unsigned int b = 0; b < n_p; ++b) {
            const double coupling = -dx * unit * grad_phi[a][c] * psi[b];
            cell_matrix(dof[c][a], dof[3][b]) += coupling;
            cell_matrix(dof[3][b], dof[c][a]) += coupling;
          }
        }
      }
      for (unsigned int a = 0; a < n_p; ++a)
        for (unsigned int b = 0; b < n_p; ++b) cell_mass(a, b) += dx * unit * unit / (mu + grad_div) * psi[a] * psi[b];
    }
    assemble_open_boundary(cell, parameters.pressure_at_inlet.value(Point<1>(time)));

    cell->get_dof_indices(ids);
    for (unsigned int a = 0; a < n_p; ++a) pressure_ids[a] = ids[dof[3][a]];
    for (unsigned int a = 0; a < n_u; ++a)
      for (unsigned int c = 0; c < 3; ++c) velocity_mass(ids[dof[c][a]]) += cell_diagonal(a);
    constraints.distribute_local_to_global(cell_matrix, cell_rhs, ids, system_matrix, right_hand_side);
    constraints.distribute_local_to_global(cell_mass, pressure_ids, mass_matrix);
  }
  system_matrix.compress(VectorOperation::add);
  mass_matrix.compress(VectorOperation::add);
  velocity_mass.compress(VectorOperation::add);
  right_hand_side.compress(VectorOperation::add);
}

// Adds the terms of a cell's faces at the inlet and the outlet. The first term is the given pressure. The second term removes
// energy from blood that flows in at an open end (Bazilevs et al. 2009).
void Flow::assemble_open_boundary(const DoFHandler<3>::active_cell_iterator &cell, double inlet_pressure) {
  FEFaceValues<3> fe_face_values(fe, face_quadrature, update_values | update_normal_vectors | update_JxW_values);
  std::vector<Tensor<1, 3>> u_old(face_quadrature.size());
  for (const auto &face : cell->face_iterators()) {
    if (!face->at_boundary()) continue;
    const bool is_inlet = face->boundary_id() == inlet;
    if (!(is_inlet && parameters.inlet == "pressure") && face->boundary_id() != outlet) continue;
    fe_face_values.reinit(cell, face);
    fe_face_values[velocity].get_function_values(solution, u_old);
    for (unsigned int q = 0; q < face_quadrature.size(); ++q) {
      const double dx = fe_face_values.JxW(q), into = std::max(0., -(u_old[q] * fe_face_values.normal_vector(q)));
      for (unsigned int a = 0; a < dof[0].size(); ++a) {
        const double phi = fe_face_values.shape_value(dof[0][a], q);
        for (unsigned int c = 0; c < 3; ++c) {
          if (is_inlet) cell_rhs(dof[c][a]) -= dx * inlet_pressure * fe_face_values.normal_vector(q)[c] * phi;
          for (unsigned int b = 0; b < dof[0].size(); ++b)
            cell_matrix(dof[c][a], dof[c][b]) +=
                dx * 0.5 * parameters.density * into * phi * fe_face_values.shape_value(dof[0][b], q);
        }
      }
    }
  }
}

// Solves the linear system by GMRES, and returns the number of iterations. The preconditioner acts from the left. The
// preconditioner turns the residual into an estimate of the error in velocity and pressure, which decides when to stop.
unsigned int Flow::solve() {
  const Preconditioner preconditioner(system_matrix, velocity_mass, mass_matrix.block(1, 1));
  PETSc::BlockVector unknown(owned, comm), scale(owned, comm);
  unknown = solution;
  unknown.block(1) /= pressure_unit;
  constraints.set_zero(unknown);
  preconditioner.vmult(scale, right_hand_side);
  SolverControl control(parameters.max_iterations, parameters.tolerance * scale.l2_norm());
  SolverGMRES<PETSc::BlockVector> solver(control, SolverGMRES<PETSc::BlockVector>::AdditionalData(120));
  try {
    solver.solve(system_matrix, unknown, right_hand_side, preconditioner);
  } catch (const SolverControl::NoConvergence &failure) {
    AssertThrow(false, ExcMessage("the linear system has not converged in " + std::to_string(failure.last_step) +
                                  " iterations (Run/Iterations)"));
  }
  constraints.distribute(unknown);
  unknown.block(1) *= pressure_unit;
  solution = unknown;
  return control.last_step();
}

// Computes the results of a step, and appends them to steps.csv.
void Flow::report(unsigned int step, double opening, std::int64_t n_marked, unsigned int iterations) {
  enum {
    inlet_area,
    inlet_push,
    inflow,
    outlet_area,
    outlet_push,
    outflow,
    sum_K,
    energy,
    force,
    edges = force + 3,
    band,
    n_sums
  };
  std::vector<double> sums(n_sums);
  FEValues<3> fe_values(fe, quadrature, update_values | update_JxW_values);
  FEFaceValues<3> fe_face_values(fe, face_quadrature, update_values | update_normal_vectors | update_JxW_values);
  std::vector<Tensor<1, 3>> u(quadrature.size()), face_u(face_quadrature.size());
  std::vector<double> face_p(face_quadrature.size());
  std::size_t point = 0;
  double fastest = 0;
  for (const auto &cell : dof_handler.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    fe_values.reinit(cell);
    fe_values[velocity].get_function_values(solution, u);
    bool is_in_band = false;
    for (unsigned int q = 0; q < quadrature.size(); ++q, ++point) {
      const double dx = fe_values.JxW(q);
      sums[sum_K] += dx * K[point];
      fastest = std::max(fastest, u[q].norm());
      sums[energy] += dx * 0.5 * parameters.density * u[q].norm_square();
      for (unsigned int c = 0; c < 3; ++c) sums[force + c] += dx * (K[point] * u[q][c] - K_u[point][c]);
      is_in_band = is_in_band || K[point] > 0;
    }
    if (is_in_band) sums[edges] += std::cbrt(cell->measure()), sums[band] += 1;
    for (const auto &face : cell->face_iterators()) {
      if (!face->at_boundary() || (face->boundary_id() != inlet && face->boundary_id() != outlet)) continue;
      const unsigned int first = face->boundary_id() == inlet ? inlet_area : outlet_area;
      fe_face_values.reinit(cell, face);
      fe_face_values[velocity].get_function_values(solution, face_u);
      fe_face_values[pressure].get_function_values(solution, face_p);
      for (unsigned int q = 0; q < face_quadrature.size(); ++q) {
        const double dx = fe_face_values.JxW(q);
        sums[first] += dx;
        sums[first + 1] += dx * face_p[q];
        sums[first + 2] += dx * (face_u[q] * fe_face_values.normal_vector(q));
      }
    }
  }
  Utilities::MPI::sum(sums, comm, sums);
  fastest = Utilities::MPI::max(fastest, comm);
  flow_rate = sums[outflow];
  const double drop = sums[inlet_push] / sums[inlet_area] - sums[outlet_push] / sums[outlet_area];
  const double eps = parameters.obstacle.half_thickness, R = parameters.obstacle.R;
  // The integral of K is R/eps times the area. The quadrature finds a share of this integral, and a flat closed valve has the
  // same share of its drop.
  const double share = R > 0 ? sums[sum_K] / (R / eps * obstacle.area()) : 1;
  const double eps_h = eps * sums[band] / sums[edges], time = step * parameters.time_step;
  out << std::fixed << std::setprecision(4) << time << " s: opening " << std::setprecision(3) << opening << ", drop "
      << std::setprecision(2) << drop << " Pa, flow " << 1e6 * flow_rate << " ml/s, at most " << fastest << " m/s, "
      << triangulation.n_global_active_cells() << " cells, eps/h " << eps_h << ", the quadrature has "
      << std::setprecision(4) << share << " of K, " << iterations << " iterations" << std::endl;
  if (rank != 0) return;
  const std::string path = parameters.folder + "/steps.csv";
  const bool is_new = !std::filesystem::exists(path);
  std::ofstream file(path, std::ios::app);
  if (is_new)
    file << "step,time,opening,drop,inflow,outflow,energy,force_x,force_y,force_z,marked,cells,unknowns,eps_h,share,"
            "area,leaflet_area,largest_speed,iterations\n";
  file << std::setprecision(17) << step << ',' << time << ',' << opening << ',' << drop << ',' << -sums[inflow] << ','
       << flow_rate << ',' << sums[energy] << ',' << sums[force] << ',' << sums[force + 1] << ',' << sums[force + 2]
       << ',' << n_marked << ',' << triangulation.n_global_active_cells() << ',' << dof_handler.n_dofs() << ',' << eps_h
       << ',' << share << ',' << sums[outlet_area] << ',' << obstacle.area() << ',' << fastest << ',' << iterations
       << '\n';
  AssertThrow(file.flush(), ExcMessage("Run/Folder: '" + path + "' cannot be written"));
}

// Writes the fields for ParaView.
void Flow::draw(unsigned int step) const {
  DataOut<3> data_out;
  const auto vector = DataComponentInterpretation::component_is_part_of_vector;
  data_out.attach_dof_handler(dof_handler);
  data_out.add_data_vector(solution, std::vector<std::string>{"velocity", "velocity", "velocity", "pressure"},
                           DataOut<3>::type_dof_data,
                           {vector, vector, vector, DataComponentInterpretation::component_is_scalar});
  Vector<double> largest_K(triangulation.n_active_cells());
  std::size_t point = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      for (unsigned int q = 0; q < quadrature.size(); ++q, ++point)
        largest_K[cell->active_cell_index()] = std::max(largest_K[cell->active_cell_index()], K[point]);
  data_out.add_data_vector(largest_K, "K");
  data_out.build_patches(2);
  data_out.write_vtu_with_pvtu_record(parameters.folder + "/", "flow", step, comm, 5);
}

// Writes the data of each cell in the last step, so that runs can be compared. The data are id, centre and edge, the integrals of
// velocity, K and K u_valve, and the pressure in the middle.
void Flow::write_cells() const {
  std::ofstream file(parameters.folder + "/cells-" + std::to_string(rank) + ".csv");
  file << std::setprecision(17) << "id,x,y,z,edge,u,v,w,p,K,K_u,K_v,K_w\n";
  FEValues<3> fe_values(fe, quadrature, update_values | update_JxW_values);
  std::vector<Tensor<1, 3>> u(quadrature.size());
  std::vector<double> p(quadrature.size());
  std::size_t point = 0;
  for (const auto &cell : dof_handler.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    fe_values.reinit(cell);
    fe_values[velocity].get_function_values(solution, u);
    fe_values[pressure].get_function_values(solution, p);
    double volume = 0, sum_p = 0, sum_K = 0;
    Tensor<1, 3> sum_u, sum_K_u;
    for (unsigned int q = 0; q < quadrature.size(); ++q, ++point) {
      const double dx = fe_values.JxW(q);
      volume += dx, sum_p += dx * p[q], sum_K += dx * K[point], sum_u += dx * u[q], sum_K_u += dx * K_u[point];
    }
    file << cell->id();
    for (unsigned int c = 0; c < 3; ++c) file << ',' << cell->center()[c];
    file << ',' << std::cbrt(volume);
    for (unsigned int c = 0; c < 3; ++c) file << ',' << sum_u[c] / volume;
    file << ',' << sum_p / volume << ',' << sum_K / volume;
    for (unsigned int c = 0; c < 3; ++c) file << ',' << sum_K_u[c] / volume;
    file << '\n';
  }
  AssertThrow(file.flush(), ExcMessage("Run/Folder: '" + parameters.folder + "' cannot be written"));
}

// ---- Restart ----------------------------------------------------------------------------------------------------------------

// Saves the mesh with the solution by p4est, and the state of the law beside it. riis itself has no state.
void Flow::save(unsigned int step, const riis_opening_switch_state &state) {
  parallel::distributed::SolutionTransfer<3, PETSc::BlockVector> transfer(dof_handler);
  transfer.prepare_for_serialization(solution);
  triangulation.save(parameters.folder + "/mesh");
  if (rank != 0) return;
  std::ofstream file(parameters.folder + "/valve", std::ios::binary);
  file << obstacle.description() << '\n' << step << '\n';
  file.write(reinterpret_cast<const char *>(&flow_rate), sizeof flow_rate);
  file.write(reinterpret_cast<const char *>(&state), sizeof state);
  AssertThrow(file.flush(), ExcMessage("Run/Folder: the state cannot be written to '" + parameters.folder + "'"));
}

unsigned int Flow::load(riis_opening_switch_state &state) {
  const std::string &folder = parameters.restart;
  std::ifstream file(folder + "/valve", std::ios::binary);
  AssertThrow(file, ExcMessage("Run/Restart from: there is no saved state in '" + folder + "'"));
  std::string description, step;
  std::getline(file, description);
  AssertThrow(description == obstacle.description(),
              ExcMessage("Run/Restart from: the state in '" + folder + "' is of another valve, " + description +
                         ", and not of " + obstacle.description()));
  std::getline(file, step);
  file.read(reinterpret_cast<char *>(&flow_rate), sizeof flow_rate);
  file.read(reinterpret_cast<char *>(&state), sizeof state);
  AssertThrow(file, ExcMessage("Run/Restart from: '" + folder + "/valve' is cut off"));
  triangulation.load(folder + "/mesh");
  set_up();
  parallel::distributed::SolutionTransfer<3, PETSc::BlockVector> transfer(dof_handler);
  PETSc::BlockVector loaded(owned, comm);
  transfer.deserialize(loaded);
  solution = loaded;
  return Utilities::string_to_int(step);
}

void Flow::run() {
  const double dt = parameters.time_step;
  auto law = riis::defaults<riis_opening_switch>();
  law.opening_duration = parameters.opening_seconds;
  law.closing_duration = parameters.closing_seconds;
  law.dwell_time = parameters.dwell_seconds;
  auto state = riis::defaults<riis_opening_switch_state>();
  if (parameters.law == "constant") state.opening = parameters.opening;

  make_mesh();
  unsigned int step = 0;
  if (!parameters.restart.empty())
    step = load(state);
  else {
    set_up();
    if (rank == 0) std::filesystem::remove(parameters.folder + "/steps.csv");
  }
  AssertThrow(step < parameters.n_steps, ExcMessage("Run/Steps is " + std::to_string(parameters.n_steps) +
                                                    ", but the saved state is of step " + std::to_string(step)));
  pressure_unit = parameters.density / dt * parameters.radius / 10;

  for (++step; step <= parameters.n_steps; ++step) {
    const double time = step * dt, opening_before = state.opening;
    if (parameters.law == "switch")  // the duct's ends have the pressures, and the last step the flow
      riis::check(riis_opening_switch_advance(&law, &state, time, parameters.pressure_at_inlet.value(Point<1>(time)),
                                              flow_rate, &state));
    obstacle.move(opening_before, state.opening, time, dt);
    while (adapt_mesh()) {
    }
    const auto n_marked = Utilities::MPI::sum<std::int64_t>(obstacle.mark(K, K_u), comm);
    AssertThrow(n_marked > 0,
                ExcMessage("step " + std::to_string(step) + ": no quadrature point is within the half thickness " +
                           Utilities::to_string(parameters.obstacle.half_thickness) + " m of the valve"));
    assemble(time);
    const unsigned int iterations = solve();
    report(step, state.opening, n_marked, iterations);
    if (parameters.pictures_every > 0 && step % parameters.pictures_every == 0) draw(step);
    if (step == parameters.save_after) save(step, state);
  }
  write_cells();
}

// An error on one rank must end all ranks.
int main(int argc, char **argv) {
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  PetscOptionsSetValue(nullptr, "-pc_factor_mat_solver_type", "mumps");  // PETSc's own LU has no ranks
  std::string text;
  try {
    Parameters parameters;
    AssertThrow(argc > 1, ExcMessage("usage: valve_flow FILE.prm [FILE.prm...]"));
    parameters.read(std::vector<std::string>(argv + 1, argv + argc));
    Flow(parameters).run();
    return 0;
  } catch (const ExceptionBase &error) {
    std::ostringstream words;
    error.print_info(words);
    text = Utilities::trim(words.str());
  } catch (const std::exception &error) {
    text = error.what();
  }
  std::cerr << "valve_flow: " << text << std::endl;
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1) MPI_Abort(MPI_COMM_WORLD, 1);
  return 1;
}
