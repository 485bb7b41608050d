// CMA-ES, asked and told. python/remodel/_designers.py gives it pycma's words.

#include "bindings.h"
#include "remodel/cmaes.h"

namespace remodel::python {

void add_designers(py::module_& module) {
  py::class_<Cmaes>(module, "_Cmaes", "CMA-ES; see remodel.CMAES.")
      .def(py::init([](const Reals& start, double sigma, std::uint64_t seed, int population) {
             return std::make_unique<Cmaes>(
                 reals(start, "x0"), CmaesOptions{.sigma = sigma, .seed = seed, .population = population});
           }),
           "start"_a, "sigma"_a, "seed"_a, "population"_a)
      .def("ask", [](Cmaes& c) { return copied(c.ask()); })
      .def("tell",
           [](Cmaes& c, const Reals& sample, double value) { return c.tell(reals(sample, "x"), value); })
      .def_property_readonly(
          "mean",
          [](const Cmaes& c) { return copied(std::vector<double>(c.mean().begin(), c.mean().end())); })
      .def_property_readonly("sigma", &Cmaes::sigma)
      .def_property_readonly("dimension", &Cmaes::dimension)
      .def_property_readonly("population", &Cmaes::population)
      .def_property_readonly("generation", &Cmaes::generation)
      .def_property_readonly("largest_deviation", &Cmaes::largest_deviation)
      .def(py::pickle([](const Cmaes& c) { return py::make_tuple(c.state()); },
                      [](const py::tuple& state) {
                        if (state.size() != 1) throw Error(ErrorCode::format, "pickle", "expected a CMA-ES");
                        return std::make_unique<Cmaes>(
                            Cmaes::restore(state[0].cast<std::string>(), "pickle"));
                      }));
}

}  // namespace remodel::python
