submodule (lagrangia_rotating_hoop) no_rotating_hoop_reference
    !! In quadruple precision no closed form is asked for: GSL has none in it.
    implicit none (type, external)

contains

    module procedure closed_form
    end procedure closed_form
end submodule no_rotating_hoop_reference
