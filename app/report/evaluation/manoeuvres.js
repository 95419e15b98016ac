// Draws an evaluation of manoeuvres alone, which lie on no map.
document.body.classList.add(
    COURSES.some(course => course.feasible) ? 'status-feasible' : 'status-infeasible');
spreads(byId('spreads'));
courses(document.querySelectorAll('.course'));
document.documentElement.dataset.drawn = 'yes';
