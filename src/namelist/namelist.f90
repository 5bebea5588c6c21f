module lagrangia_namelist
    !! Strict reading of namelist files: the one module others use.
    !!
    !! `parse_namelist` (and `apply_override`), then `get_...` for every key there may be, then
    !! `refuse_unknown_keys` and `refuse_unknown_groups`. Group and key names are in lower case.
    use lagrangia_namelist_access, only: get_integer, get_logical, get_real, get_reals, &
                                         get_string, get_strings
    use lagrangia_namelist_lookup, only: point_advice, refuse_value
    use lagrangia_namelist_parser, only: apply_override, parse_namelist
    use lagrangia_namelist_tree, only: namelist_t
    use lagrangia_namelist_unknown, only: has_group, has_key, refuse_unknown_groups, &
                                          refuse_unknown_keys
    implicit none (type, external)
    private
    public :: apply_override, get_integer, get_logical, get_real, get_reals, get_string, &
              get_strings, has_group, has_key, namelist_t, parse_namelist, point_advice, &
              refuse_unknown_groups, refuse_unknown_keys, refuse_value
end module lagrangia_namelist
