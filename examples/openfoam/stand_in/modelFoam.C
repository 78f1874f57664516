// SPDX-License-Identifier: Apache-2.0
// Runs riisModel.C with the libraries of OpenFOAM 1912: a laminar flow by PISO, whose equations take sources from fvModels as the
// Foundation's module incompressibleFluid does. ./run openfoam compares the flow with that of riisValve and riisSource in
// pimpleFoam.
#include "adjustPhi.H"
#include "argList.H"
#include "constrainHbyA.H"
#include "constrainPressure.H"
#include "findRefCell.H"
#include "fvModels.H"
#include "fvc.H"
#include "fvm.H"
#include "pimpleControl.H"
#include "surfaceFields.H"

namespace Foam {
defineTypeNameAndDebug(fvModel, 0);
defineRunTimeSelectionTable(fvModel, dictionary);
}  // namespace Foam

using namespace Foam;

int main(int argc, char *argv[]) {
  argList args(argc, argv);
  Time time(Time::controlDictName, args);
  fvMesh mesh(IOobject(fvMesh::defaultRegion, time.timeName(), time, IOobject::MUST_READ));
  pimpleControl pimple(mesh);
  const auto file = [&](const char *name) {
    return IOobject(name, time.timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE);
  };
  volScalarField p(file("p"), mesh);
  volVectorField U(file("U"), mesh);
  surfaceScalarField phi(IOobject("phi", time.timeName(), mesh, IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE),
                         fvc::flux(U));
  label pRefCell = 0;
  scalar pRefValue = 0;
  setRefCell(p, pimple.dict(), pRefCell, pRefValue);
  mesh.setFluxRequired(p.name());
  const IOdictionary transport(IOobject("transportProperties", time.constant(), mesh, IOobject::MUST_READ));
  const volScalarField nuEff(IOobject("nuEff", time.timeName(), mesh), mesh,
                             dimensionedScalar("nu", dimViscosity, transport));
  fvModels &models = fvModels::New(mesh);

  while (time.run()) {
    ++time;
    Info << "Time = " << time.timeName() << nl << endl;
    while (pimple.loop()) {
      models.correct();
      fvVectorMatrix UEqn(fvm::ddt(U) + fvm::div(phi, U) - fvc::div(nuEff * dev2(T(fvc::grad(U)))) -
                              fvm::laplacian(nuEff, U) ==
                          models.source(U));
      UEqn.relax();
      solve(UEqn == -fvc::grad(p));
      while (pimple.correct()) {
        const volScalarField rAU(1 / UEqn.A());
        const volVectorField HbyA(constrainHbyA(rAU * UEqn.H(), U, p));
        surfaceScalarField phiHbyA("phiHbyA", fvc::flux(HbyA) + fvc::interpolate(rAU) * fvc::ddtCorr(U, phi));
        if (p.needReference()) adjustPhi(phiHbyA, U, p);
        constrainPressure(p, U, phiHbyA, rAU);
        const fvScalarMatrix source(models.sourceProxy(p));
        while (pimple.correctNonOrthogonal()) {
          fvScalarMatrix pEqn(fvm::laplacian(rAU, p) == fvc::div(phiHbyA) - source);
          pEqn.setReference(pRefCell, pRefValue);
          pEqn.solve(mesh.solver(p.select(pimple.finalInnerIter())));
          if (pimple.finalNonOrthogonalIter()) phi = phiHbyA - pEqn.flux();
        }
        U = HbyA - rAU * fvc::grad(p);
        U.correctBoundaryConditions();
      }
    }
    time.write();
  }
}
