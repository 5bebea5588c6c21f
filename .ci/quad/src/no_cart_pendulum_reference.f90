submodule (lagrangia_cart_pendulum) no_cart_pendulum_reference
    !! In quadruple precision no closed form is asked for: GSL has none in it.
    implicit none (type, external)

contains

    module procedure closed_form
    end procedure closed_form
end submodule no_cart_pendulum_reference
