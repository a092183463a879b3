/* The exchange of firmware/rt/latest_value.h under every interleaving: the reader never sees half a value and
   never an older one than before. A value is two bytes that are written one after the other.
   -DWRONG_EXCHANGE replaces the atomic exchange by a read and a write, -DWRONG_BUFFERS lets the writer keep
   its buffer after handing it over. Both must fail. */
#define WRITES 4
#define FRESH 4
#define INDEX 3

byte first[3], second[3];
byte middle = 1;

proctype Writer() {
  byte back = 0, n = 1, old;
  do
  :: n > WRITES -> break
  :: n <= WRITES ->
     first[back] = n;
     second[back] = n;
#ifdef WRONG_EXCHANGE
     old = middle;
     middle = back | FRESH;
#else
     atomic { old = middle; middle = back | FRESH };
#endif
#ifndef WRONG_BUFFERS
     back = old & INDEX;
#endif
     n++
  od
}

proctype Reader() {
  byte front = 2, last = 0, reads = 0, a, b, old;
  do
  :: reads == WRITES + 2 -> break
  :: reads < WRITES + 2 ->
     if
     :: (middle & FRESH) != 0 ->
#ifdef WRONG_EXCHANGE
        old = middle;
        middle = front;
#else
        atomic { old = middle; middle = front };
#endif
        front = old & INDEX
     :: else -> skip
     fi;
     a = first[front];
     b = second[front];
     assert(a == b);      /* never half a value */
     assert(a >= last);   /* never an older one */
     last = a;
     reads++
  od
}

init { atomic { run Writer(); run Reader() } }
