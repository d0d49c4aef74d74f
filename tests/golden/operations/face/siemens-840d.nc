; program face, SINUMERIK 840D
; part face, aluminium, 4 mm thick
; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
; origin: axis of the part, Z0 on top of the stock
; origin G54, Z0 on top of the stock, units mm and mm/min
; T20 D 16 mm: mill-16, end mill
G17 G710 G40 G90 G94 COMPOF
G64
G0 SUPA Z0 D0
; operation: face: face
T20
M6
G54 S4377 M3
G0 X-29 Y-10
D1 Z5
M8
Z1
G1 Z-0.5 F2328
X29
Y0
X-29
Y10
X29
G0 Z5
M9
M5
G0 SUPA Z0 D0
M30
