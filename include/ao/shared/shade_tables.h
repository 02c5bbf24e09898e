// Where materials, lights and blend programs lie in the table of words that ao/shading.hpp packs. Reals are bits of floats.

AO_CONST int ao_header_materials = 0; // offsets of the parts
AO_CONST int ao_header_lights = 1;
AO_CONST int ao_header_light_count = 2;
AO_CONST int ao_header_entries = 3; // two words per material, then per blend: first instruction's offset, number
AO_CONST int ao_header_entry_count = 4;
AO_CONST int ao_header_weights = 5; // k of every blend
AO_CONST int ao_header_ambient = 6;
AO_CONST int ao_header_material_count = 7;
AO_CONST int ao_header_words = 8;

// ambient, shininess, diffuse, 1 for Phong, specular, +1 or -1 for the green of the normal map, emission, footprint of the
// reflection; repeat, factor of the footprint, then maps + 1, 0 for none: diffuse, specular, reflection, normal; 1 reserved
AO_CONST int ao_material_words = 24;

// vector, 1 for point, color, reserved, attenuation, reserved
AO_CONST int ao_light_words = 12;

AO_CONST int ao_ambient_words = 27; // ao_ambient_light

// operation + 256 target + 65536 first + 16777216 second register, then
//   leaf: material, normal (below), reserved     blend: blend node, mask + 1 or 0, reserved     load: picture, 2 reserved
AO_CONST int ao_instruction_words = 4;
AO_CONST int ao_leaf = 0;  // shade with a material
AO_CONST int ao_mix = 1;   // blend two registers
AO_CONST int ao_fetch = 2; // read a target of an earlier pass at the own pixel
AO_CONST int ao_register_limit = 16;

AO_CONST int ao_normal_of_geometry = 0; // as the normal target has it
AO_CONST int ao_normal_of_surface = 1;  // interpolated, without any map
AO_CONST int ao_normal_of_map = 2;      // interpolated, with the leaf's map
