#ifndef NESTED_H
#define NESTED_H
const int nested = 1; // no newline at the end
#endif